// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/crowd.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

constexpr double pitch = 0.08; // between the centres of cubes of 40 mm

/// Cubes in a square, side by side, the first at the origin.
scene::Description field(int count)
{
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    scene::Description scene{.name = "field"};
    for (int i = 0; i < count; ++i) {
        scene.bodies.push_back(cube());
        scene.bodies.back().position = {{pitch * (i % side), 0.0, pitch * (i / side)}};
    }
    scene.planes = {platform()};
    scene.hands.count = 0;
    return scene;
}

std::vector<Entry> entries(std::span<const Subject> subjects, const EngineOptions& options)
{
    std::vector<Entry> entries;
    for (const Subject& subject : subjects) entries.push_back({subject.name, &subject, options});
    return entries;
}

class Costs {
public:
    Costs(std::span<const Subject> subjects, bool is_quick)
        : subjects_{subjects}, is_quick_{is_quick}
    {}

    std::vector<Row> measure()
    {
        paper();
        sleepers();
        awake(100);
        awake(1000);
        flight();
        if (!is_quick_) landed();
        return std::move(rows_);
    }

private:
    [[nodiscard]] double seconds() const { return is_quick_ ? 0.1 : 0.5; }

    void paper()
    {
        const auto all = entries(subjects_, {});
        append(rows_, compare({"paper's scene, locked", "", "p50_ns", 75.0, 13.0},
                              costs_of(paper_course(scene::Turning::locked), all, seconds())));
        append(rows_, compare({"paper's scene, 6-DoF", "", "p50_ns", 330.0, 5.0},
                              costs_of(paper_course(scene::Turning::free), all, seconds())));
        EngineOptions options;
        options.hip_force = HipForce::native;
        std::vector<Entry> native;
        for (const Subject& subject : subjects_) {
            if (subject.has_native_hips)
                native.push_back({subject.name + " native", &subject, options});
        }
        append(rows_, compare({"paper's scene, locked, native springs", "", "p50_ns"},
                              costs_of(paper_course(scene::Turning::locked), native, seconds())));
        append(rows_, compare({"paper's scene, 6-DoF, native springs", "", "p50_ns"},
                              costs_of(paper_course(scene::Turning::free), native, seconds())));
    }

    void sleepers()
    {
        EngineOptions options;
        options.sleeping = true;
        options.begins_asleep = true;
        double single = 0.0;
        for (const int count : {1, 10, 100, 1000, 10000}) {
            auto all = entries(subjects_, options);
            if (!is_quick_ && count <= 1000) add_stock(all, options);
            const auto costs = costs_of(pushed_crowd(count), all, seconds());
            Question question{fmt::format("1 pushed, {} asleep", count - 1), "", "p50_ns"};
            if (count == 10000) {
                question.target = 600.0;
                question.ratio_min = 50.0;
            }
            append(rows_, compare(question, costs));
            const double own = costs.front().value;
            if (count == 1) single = own;
            if (count == 10000) {
                append(rows_,
                       compare({question.name, "hapnet alone", "p50_ns_above_one_cube", 150.0},
                               std::vector<Reading>{{"hapnet", own_family, own - single}}));
            }
        }
    }

    void add_stock(std::vector<Entry>& all, EngineOptions options) const
    {
        options.is_stock = true;
        for (const Subject& subject : subjects_) {
            if (subject.family != own_family) {
                all.push_back({subject.name + " stock", &subject, options});
            }
        }
    }

    void per_body(const Course& course, Question question)
    {
        question.metric = "p50_ns_per_body";
        auto costs = costs_of(course, entries(subjects_, {}), seconds());
        for (Reading& one : costs) one.value /= static_cast<double>(course.scene.bodies.size());
        append(rows_, compare(question, costs));
    }

    void awake(int count)
    {
        Course course{field(count), 1e4, {}};
        course.warm_up_s = 0.02;
        Question question{fmt::format("{} awake at rest", count), "", ""};
        question.target = count == 100 ? 500.0 : 250.0; // 100 bodies: 5 % of a tick of 1 ms
        if (count == 1000) question.ratio_min = 2.3;
        per_body(course, question);
    }

    void flight() { per_body(flying_crowd(1000), {"1000 in flight", "", "", 25.0, 8.0}); }

    void landed()
    {
        Course course{field(1000), 1e4, {}};
        for (std::size_t i = 0; i < course.scene.bodies.size(); ++i) {
            const double turn = 0.001 * static_cast<double>(i);
            auto& body = course.scene.bodies[i];
            body.position.value.y = 0.002;
            body.orientation = {std::cos(turn), 0.0, std::sin(turn), 0.0};
        }
        course.warm_up_s = 0.3;
        per_body(course, {"1000 landed", "", ""});
    }

    std::span<const Subject> subjects_;
    bool is_quick_;
    std::vector<Row> rows_;
};

} // namespace

Course pushed_crowd(int count)
{
    Course course = paper_course(scene::Turning::free);
    const scene::HandDescription hands = course.scene.hands;
    course.scene = field(count);
    course.scene.hands = hands;
    course.warm_up_s = 0.3; // until resting bodies have fallen asleep
    return course;
}

Course flying_crowd(int count)
{
    Course course{field(count), 2.0, {}};
    course.scene.planes.clear();
    for (std::size_t i = 0; i < course.scene.bodies.size(); ++i) {
        const double turn = 0.001 * static_cast<double>(i);
        course.scene.bodies[i].angular_velocity = {turn, 1.0, -turn};
    }
    return course;
}

std::vector<Row> measure_costs(std::span<const Subject> subjects, bool is_quick)
{
    return Costs{subjects, is_quick}.measure();
}

} // namespace hapnet::bench
