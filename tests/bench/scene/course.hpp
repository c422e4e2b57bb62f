// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/engine.hpp"

#include <functional>
#include <span>

namespace hapnet::bench {

/// A scene, its duration, and the motion of its hands.
struct Course {
    scene::Description scene;
    double duration_s = 1.0;
    std::function<scene::HandInput(std::uint32_t hand, double time_s)> hands; // empty: none
    double warm_up_s = 0.0; // before anything is timed
};

/// Runs a course from its start to its end; `after` gets the time at the end of every step.
void run(Engine& engine, const Course& course, double tick_s,
         const std::function<void(double time_s)>& after = {});

/// An engine to time, and its setup.
struct Contender {
    const Subject* subject = nullptr;
    EngineOptions options;
};

/// Returns nanoseconds per step, hands included: the median over blocks of about 20 us, one step at
/// least. The contenders take turns of some blocks in one thread, so that other load affects all
/// equally. A course that ends begins again. NaN for an engine that cannot run it.
[[nodiscard]] std::vector<double> race(const Course& course, std::span<const Contender> contenders,
                                       double seconds_each);

} // namespace hapnet::bench
