// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/course.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace hapnet::bench {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double block_ns = 20'000.0; // long beside the clock's 30 ns, short beside a time slice
constexpr std::size_t block_steps_max = 256; // the same for fast and slow engines
constexpr double turn_ns = 200'000.0;        // rare paths, too, are warm in most of its blocks
constexpr std::size_t blocks_min = 9;
constexpr std::size_t blocks_max = 400;

std::size_t steps_of(double duration_s, double tick_s)
{
    return static_cast<std::size_t>(std::llround(duration_s / tick_s));
}

void set_hands(Engine& engine, const Course& course, double time_s)
{
    if (!course.hands) return;
    for (std::uint32_t i = 0; i < course.scene.hands.count; ++i) {
        engine.set_hand(i, course.hands(i, time_s));
    }
}

/// A contender on a course that begins again and again.
class Runner {
public:
    Runner(const Course& course, const Contender& contender)
        : course_{&course}, contender_{contender}
    {
        begin();
        if (!engine_) return;
        block(2); // the first steps fill caches that later steps use
        const double once = block(4);
        block_steps_ = static_cast<std::size_t>(
            std::clamp(block_ns / once, 1.0, static_cast<double>(block_steps_max)));
    }

    [[nodiscard]] bool can_run() const { return engine_ != nullptr; }
    [[nodiscard]] double used_s() const { return used_ns_ * 1e-9; }
    [[nodiscard]] std::size_t blocks() const { return samples_.size(); }

    void take_turn()
    {
        const double end_s = used_s() + turn_ns * 1e-9;
        do {
            samples_.push_back(block(block_steps_));
        } while (used_s() < end_s);
    }

    [[nodiscard]] double median() const
    {
        if (samples_.empty()) return std::numeric_limits<double>::quiet_NaN();
        auto sorted = samples_;
        const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
        std::nth_element(sorted.begin(), middle, sorted.end());
        return *middle;
    }

private:
    void begin()
    {
        engine_ = contender_.subject->make(course_->scene, contender_.options);
        step_ = 0;
        if (!engine_) return;
        const std::size_t warm_up = steps_of(course_->warm_up_s, contender_.options.tick_s);
        while (step_ < warm_up) {
            set_hands(*engine_, *course_, time_s());
            engine_->step();
            ++step_;
        }
    }

    [[nodiscard]] double time_s() const
    {
        return static_cast<double>(step_) * contender_.options.tick_s;
    }

    /// The mean time of one step. The hands' places are computed beforehand. The step before them
    /// is not timed: it reloads what the other contenders displaced from the caches.
    double block(std::size_t steps)
    {
        if (step_ + steps + 1 > steps_of(course_->duration_s, contender_.options.tick_s)) begin();
        const std::uint32_t hands = course_->hands ? course_->scene.hands.count : 0;
        inputs_.clear();
        for (std::size_t i = 0; i < steps + 1; ++i, ++step_) {
            for (std::uint32_t hand = 0; hand < hands; ++hand) {
                inputs_.push_back(course_->hands(hand, time_s()));
            }
        }
        const scene::HandInput* input = inputs_.data();
        const auto step = [&] {
            for (std::uint32_t hand = 0; hand < hands; ++hand) engine_->set_hand(hand, *input++);
            engine_->step();
        };
        step();
        const auto start = Clock::now();
        for (std::size_t i = 0; i < steps; ++i) step();
        const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
        used_ns_ += ns;
        return ns / static_cast<double>(steps);
    }

    const Course* course_;
    Contender contender_;
    std::unique_ptr<Engine> engine_;
    std::size_t step_ = 0;
    std::size_t block_steps_ = 1;
    double used_ns_ = 0.0;
    std::vector<scene::HandInput> inputs_;
    std::vector<double> samples_;
};

} // namespace

void run(Engine& engine, const Course& course, double tick_s,
         const std::function<void(double time_s)>& after)
{
    const std::size_t steps = steps_of(course.duration_s, tick_s);
    for (std::size_t i = 0; i < steps; ++i) {
        set_hands(engine, course, static_cast<double>(i) * tick_s);
        engine.step();
        if (after) after(static_cast<double>(i + 1) * tick_s);
    }
}

std::vector<double> race(const Course& course, std::span<const Contender> contenders,
                         double seconds_each)
{
    std::vector<Runner> runners;
    runners.reserve(contenders.size());
    for (const Contender& one : contenders) runners.emplace_back(course, one);
    for (bool is_going = true; is_going;) {
        is_going = false;
        for (Runner& runner : runners) {
            const bool has_enough =
                runner.blocks() >= blocks_min &&
                (runner.used_s() >= seconds_each || runner.blocks() >= blocks_max);
            if (!runner.can_run() || has_enough) continue;
            runner.take_turn();
            is_going = true;
        }
    }
    std::vector<double> medians;
    for (const Runner& runner : runners) medians.push_back(runner.median());
    return medians;
}

} // namespace hapnet::bench
