// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/table.hpp"
#include "lab/virtual_time/trace.hpp"
#include "scene/description.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::results {

// The motion and the forces of the sides over time.

/// Returns the table replay/ALGORITHM-TASK: samples of a trace of two sides, `rows_per_s` a second,
/// or all samples when there are fewer. For each side, A as `l` and B as `r`, it has the positions
/// of the first shared body and of the hand in mm, and the force on the hand along x in N. Where a
/// body turns or several are shared, it also has the orientation of that body and the pose of each
/// further one (`l2x`, `l2qw`).
[[nodiscard]] Table replay_table(const virtual_time::Trace& trace, std::uint32_t rows_per_s);
/// Returns the rows in the form in which a session keeps them: CSV without a header.
[[nodiscard]] std::string kept_lines(const Table& replay);
[[nodiscard]] Table from_kept_lines(std::string name, std::string_view lines);

/// One of the players, with its copy of the shared bodies, in equal steps of time.
struct ReplaySide {
    std::string name; // such as "A" or "peer 3"
    bool is_left = true;
    std::vector<glm::dvec3> hand_mm{};
    std::vector<glm::dvec3> force_n{}; // force on the hand
    /// The poses of each shared body, one for each step.
    std::vector<std::vector<virtual_time::Pose>> bodies{};
};

/// The motion and the forces of all sides, in equal steps of time.
struct Replay {
    std::string algorithm;
    std::string task;
    double start_s = 0.0;
    double step_s = 0.01;
    std::vector<ReplaySide> sides{};                 // two or more, each with at least two steps
    scene::Description scene = scene::paper_scene(); // scene in which the session was played
    std::vector<std::size_t> shared{};               // numbers of the shared bodies in `scene`

    [[nodiscard]] std::size_t steps() const { return sides.front().hand_mm.size(); }
};

/// Returns the number of the first movable body.
[[nodiscard]] std::size_t first_movable(const scene::Description& scene);

/// Returns the sides of a trace with every `every`-th tick; `names` are those of the sides.
[[nodiscard]] std::vector<ReplaySide> replay_sides(const virtual_time::Trace& trace,
                                                   std::span<const std::string> names,
                                                   std::size_t every);

/// Reads a replay from the table replay/ALGORITHM-TASK, in the paper's scene. Fails when the table
/// has fewer than two rows.
[[nodiscard]] base::Result<Replay> replay_of(const Table& table);

/// Returns the table replay_scenes without rows. It gets a row for each replay in another scene
/// than the paper's. The scene is stored as TOML, only in JSON.
[[nodiscard]] Table replay_scenes();
/// Puts the replay into the scene of a text from that table. Returns false if the text is not a
/// scene with those bodies.
[[nodiscard]] bool set_scene(Replay& replay, const std::string& toml);

} // namespace hapnet::lab::results
