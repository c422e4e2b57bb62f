// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/course.hpp"

namespace hapnet::bench {

/// A figure of a run, and the limit for Hapnet's value.
struct Measure {
    std::string metric; // with its unit: "error_m"
    double value = 0.0;
    std::optional<double> target;
};

/// A course whose end is known, and the error of an engine.
struct Scenario {
    std::string name;
    std::string reference; // what the error is against: "analytic", "rk4", "itself" at the start
    Course course;
    std::function<std::vector<Measure>(Engine&, const Course&, double tick_s)> measure;
    bool has_native = false;     // also run with the peers' own compliant contact
    double cost_ratio_min = 0.0; // a peer's cost over Hapnet's, at least; 0: no target
    double cost_ns_max = 0.0;    // of Hapnet's step; 0: no target
    EngineOptions options{};     // of every subject
    bool is_flight = false;      // also run with an integrator of fourth order
};

/// The cube of all these scenes: 40 mm, 0.1 kg, friction 0.3.
[[nodiscard]] scene::BodyDescription cube();
/// The platform on which a cube at the origin rests, with friction 0.3.
[[nodiscard]] scene::PlaneDescription platform();
/// The i-th of `count` evenly distributed orientations.
[[nodiscard]] glm::dquat even_turn(int i, int count);
/// A cube and no more: no gravity, no hands.
[[nodiscard]] scene::Description lone_cube(scene::Turning turning);

// The scenarios of each kind; `locked` that the cube cannot turn.
[[nodiscard]] Scenario ballistic();
[[nodiscard]] Scenario slide(double degrees, scene::Turning turning);
[[nodiscard]] Scenario tumble();
[[nodiscard]] Scenario off_centre_push();
/// A cube that bounces off a hand of this stiffness, hit at a distance from its centre after a
/// flight.
[[nodiscard]] Scenario bounce(double stiffness_n_per_m, double offset_m, scene::Turning turning,
                              double gap_m = 1.23e-4);
[[nodiscard]] Scenario steady_push(scene::Turning turning);
[[nodiscard]] Scenario symmetric_squeeze(scene::Turning turning);
[[nodiscard]] Scenario squeezed_oscillation(scene::Turning turning,
                                            double stiffness_n_per_m = 1000.0);
[[nodiscard]] Scenario asymmetric_squeeze(scene::Turning turning);
[[nodiscard]] Scenario wall(double restitution, scene::Turning turning);
[[nodiscard]] Scenario stack(double duration_s);
/// The stack in ticks at or beyond the limits of each engine.
[[nodiscard]] Scenario stack_in_long_ticks();
/// The steady push on each engine's own plane, instead of the body that makes better contacts.
[[nodiscard]] Scenario steady_push_on_own_plane();

/// One scenario for each other element of a scene: spheres, capsules, bodies of several parts,
/// fields, kinematic bodies, planes that hands feel, and hands with friction.
[[nodiscard]] std::vector<Scenario> element_scenarios();
/// Everyday scenes that are no engine's best case.
[[nodiscard]] std::vector<Scenario> everyday_scenarios();

/// The paper's scene, pushed to and fro between two hands: as it is, or with a cube that can turn
/// and has dry friction.
[[nodiscard]] Course paper_course(scene::Turning turning);

/// All scenarios, in the order of the specification.
[[nodiscard]] std::vector<Scenario> all_scenarios(bool is_quick);

} // namespace hapnet::bench
