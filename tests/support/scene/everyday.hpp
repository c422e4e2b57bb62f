// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/world.hpp"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace hapnet::test {

/// A kind of scene that people build every day.
enum class Everyday : std::uint8_t {
    mild,    // bodies of similar size and weight in a room, with hands
    tray,    // small parts that fall into a tray
    rattle,  // one spinning box in a closed cube
    pens,    // plates on capsules
    cradle,  // elastic balls in a row
    hostile, // like mild, with masses from 1 g to 1000 kg
};
inline constexpr std::size_t everyday_kinds = 6;

[[nodiscard]] std::string_view name_of(Everyday kind);

/// A hand that moves evenly for a while.
struct HandLeg {
    std::uint32_t ticks = 0;
    glm::dvec3 velocity{0.0};
};

/// A scene without overlap at its start, and how its hands move.
struct EverydayPlay {
    scene::Description description;
    scene::FreezeOptions options;
    std::uint32_t ticks = 2000;
    double height = 0.0;  // m, of the scene
    glm::dvec3 room{0.0}; // m: half the edges of the room around the origin that bodies stay in
    bool is_open = false; // above
    std::vector<glm::dvec3> hands;
    std::vector<std::vector<HandLeg>> legs; // of each hand
};

/// Draws a play. It is a pure function of the kind, the seed and the tick.
[[nodiscard]] EverydayPlay everyday_play(Everyday kind, std::uint64_t seed, base::Duration tick);

/// The result of a play, by formulas of this judge, which uses no number of the scene's code.
struct EverydayOutcome {
    /// The largest energy beyond that at the start and the work of hands, as a share of the scale:
    /// kinetic energy at the start, weight times height, and the work of hands.
    double gain = 0.0;
    double kept = 0.0;        // energy at the end over that at the start
    bool has_escaped = false; // a body left the room
    double restless = 0.0;    // m/s: the fastest corner at the end
};
[[nodiscard]] EverydayOutcome play_everyday(const EverydayPlay& play);

/// True if two bodies of one part, taken as boxes, overlap: by 15 separating axes.
[[nodiscard]] bool boxes_overlap(const scene::BodyDescription& a, const scene::BodyDescription& b);

/// Kinetic energy of a body of one part, from its shape and its motion, J.
[[nodiscard]] double kinetic_energy_of(const scene::BodyDescription& form,
                                       const scene::BodyState& state);

} // namespace hapnet::test
