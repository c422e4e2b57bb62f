// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/sweep.hpp"
#include "scene/hand/constant_contact.hpp"
#include "scene/maths/lanes.hpp"
#include "scene/state.hpp"

#include <array>
#include <optional>
#include <span>

namespace hapnet::scene {

/// A face with a hand in front of its middle part. The result stays valid as long as the body does
/// not turn and the hand moves no farther than `room` from the place where it was found.
struct AmidFace {
    std::uint64_t turns = 0; // see SweptBox::turns
    glm::dvec3 offset{0.0};  // from the body's centre to the hand
    double room = -1.0;      // m: how far the hand may move; < 0: it is not amid a face
    glm::dvec3 normal{0.0};
    double half = 0.0; // from the body's centre to the face
};

/// One or two hands that press a body amid faces and go on doing so, side by side in lanes. Their
/// forces are those that HandContacts would find, bit for bit. A single hand is stored in both
/// lanes.
class PressingHands {
public:
    struct Hand {
        std::uint32_t hand = 0;
        const AmidFace& face;
        const HandSpring& spring;
    };
    PressingHands() = default;
    /// `a` and `b` may be the same hand.
    PressingHands(BodyId body, const Hand& a, const Hand& b);

    [[nodiscard]] std::uint32_t hand(std::size_t lane) const { return hand_[lane]; }
    [[nodiscard]] const PressingSprings& springs() const { return springs_; }
    /// True if the hand, one of these or not, may act as in the last tick. `near` lists the bodies
    /// that it may reach.
    [[nodiscard]] bool is_where_it_was(std::uint32_t hand, const HandInput& input,
                                       std::span<const PartId> near) const;
    /// Finds the springs of this tick, and the hands' places from the body's centre. Returns
    /// nullopt when a hand is no longer amid its face or does not press it.
    [[nodiscard]] std::optional<TwoVectors> press(const WorldState& state, const SweptBox& now,
                                                  const glm::dvec3& velocity);
    /// Reports the forces to all hands. `impulse` holds the springs' impulses on the body.
    void report(const WorldConfig& config, WorldState& state, const TwoVectors& impulse) const;

private:
    BodyId body_ = 0;
    std::array<std::uint32_t, 2> hand_{};
    PressingSprings springs_;
    TwoVectors found_{};    // AmidFace::offset
    Two room_{}, half_{};   // AmidFace::room and AmidFace::half
    Two depth_{};           // in this tick
    TwoVectors at_start_{}; // N: force on each hand at the start of the tick
};

} // namespace hapnet::scene
