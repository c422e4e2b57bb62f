// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/instructions.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

constexpr int few_steps = 300, many_steps = 1300; // the common part cancels in the difference

Course course_of(bool is_locked)
{
    return paper_course(is_locked ? scene::Turning::locked : scene::Turning::free);
}

/// The instructions of a whole run under callgrind; nullopt when it did not work.
std::optional<double> collected(const std::string& command)
{
    FILE* const pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return std::nullopt;
    constexpr std::string_view label = "Collected : ";
    std::optional<double> count;
    std::array<char, 512> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
        const std::string_view text{line.data()};
        if (const auto at = text.find(label); at != std::string_view::npos) {
            count = std::strtod(text.substr(at + label.size()).data(), nullptr);
        }
    }
    return pclose(pipe) == 0 ? count : std::nullopt;
}

std::optional<double> per_step(const Subject& subject, bool is_locked)
{
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const auto of = [&](int steps) {
        return collected(fmt::format("valgrind --tool=callgrind --callgrind-out-file=/dev/null "
                                     "'{}' --spin {} {} {} 2>&1",
                                     self, subject.name, is_locked ? "locked" : "free", steps));
    };
    const auto few = of(few_steps), many = of(many_steps);
    if (!few || !many) return std::nullopt;
    return (*many - *few) / (many_steps - few_steps);
}

} // namespace

std::vector<Row> count_instructions(std::span<const Subject> subjects)
{
    std::vector<Row> rows;
    for (const bool is_locked : {true, false}) {
        std::vector<Reading> readings;
        for (const Subject& subject : subjects) {
            const auto count = per_step(subject, is_locked);
            if (count) readings.push_back({subject.name, subject.family, *count});
        }
        Question question{is_locked ? "paper's scene, locked" : "paper's scene, 6-DoF", "",
                          "instructions_per_step"};
        question.target = is_locked ? 1500.0 : 5000.0;
        question.ratio_min = is_locked ? 20.0 : 6.0;
        const auto some = compare(question, readings);
        rows.insert(rows.end(), some.begin(), some.end());
    }
    return rows;
}

bool spin(const std::string& subject, bool is_locked, int steps)
{
    const auto all = subjects();
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const Subject& one) { return one.name == subject; });
    if (found == all.end()) return false;
    const Course course = course_of(is_locked);
    const EngineOptions options;
    std::vector<scene::HandInput> inputs; // equal for few and many steps: not counted
    for (int i = 0; i < many_steps; ++i) {
        for (std::uint32_t hand = 0; hand < course.scene.hands.count; ++hand) {
            inputs.push_back(course.hands(hand, options.tick_s * i));
        }
    }
    const auto engine = found->make(course.scene, options);
    if (!engine) return false;
    const scene::HandInput* input = inputs.data();
    for (int i = 0; i < std::min(steps, many_steps); ++i) {
        for (std::uint32_t hand = 0; hand < course.scene.hands.count; ++hand) {
            engine->set_hand(hand, *input++);
        }
        engine->step();
    }
    return true;
}

} // namespace hapnet::bench
