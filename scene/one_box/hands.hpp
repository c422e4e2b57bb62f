// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/motion.hpp"
#include "scene/one_box/sphere_contact.hpp"

#include <array>
#include <optional>
#include <vector>

namespace hapnet::scene {

/// A hand at a face of the box. Without a face the hand does not touch, or is at an edge or a
/// corner.
struct FaceContact {
    std::uint32_t hand = 0;
    BoxFace face;
    double depth = 0.0;
};

/// The hands' contacts with the box and the fixed boxes, and the memory that the next tick needs.
class BoxHands {
public:
    BoxHands(const WorldConfig& config, const Bodies& bodies, const BodyProperties& movable);

    /// Adds the springs between the hands and the box to `box`. The forces of the fixed boxes on
    /// the hands are reported at once.
    void collide(const WorldConfig& config, WorldState& state, BoxMotion& box);
    /// Adds the forces of soft springs at edges and corners. Call it when the trajectories of the
    /// axes are known. Midpoint rule: second order, and it neither makes nor loses energy.
    static void add_held_springs(BoxMotion& box);
    /// True if a hand's grip exceeded its greatest force in the tick that `box` has run. Then
    /// `again`, the tick before it ran, gets that greatest force for the whole tick instead.
    static bool limit_grip(const WorldConfig& config, WorldState& state, const BoxMotion& box,
                           BoxMotion& again);
    /// Reports the forces of the springs in the tick to the hands.
    static void report(const WorldConfig& config, WorldState& state, const BoxMotion& box);
    /// Returns the energy stored in the springs of the hands that hold the box, J.
    [[nodiscard]] double stored_in_grips(const WorldConfig& config, const WorldState& state,
                                         const PerAxis& box_position) const;
    /// Forgets the hands' contacts after the box was put elsewhere.
    void forget_box();

private:
    struct FixedBox {
        PerAxis centre;
        PerAxis half;
    };
    struct Memory {
        BoxFace entered;                  // face of the movable box through which the hand came in
        std::optional<PerAxis> held_at{}; // held point, from the box's centre
        PerAxis query_position{};
        double clear = -1.0; // no fixed box is nearer to `query_position`, along every axis

        /// True if no fixed box is within reach of the hand in this tick.
        [[nodiscard]] bool is_clear(const WorldConfig& config, const HandInput& input) const
        {
            const PerAxis place = per_axis(input.position.value);
            const PerAxis velocity = per_axis(input.velocity.value);
            double reach = 0.0;
            for (std::size_t i = 0; i < 3; ++i) {
                const double gone = std::abs(place[i] - query_position[i]);
                reach = std::max(gone + config.tick * std::abs(velocity[i]), reach);
            }
            return reach + config.hands.radius_m < clear;
        }
    };

    void add_grip(const WorldConfig& config, WorldState& state, BoxMotion& box,
                  std::uint32_t index);
    void collide_box(const WorldConfig& config, WorldState& state, BoxMotion& box,
                     std::uint32_t index);
    /// Handles the general case: all but a hand straight in front of a face. Adds hands at edges
    /// and corners to `box`. Returns the contact of a hand that pushes a face.
    FaceContact collide_near_box(const WorldConfig& config, WorldState& state, BoxMotion& box,
                                 std::uint32_t index);
    void collide_fixed_boxes(const WorldConfig& config, WorldState& state, std::uint32_t index);

    BodyId body_;
    PerAxis half_;
    double margin_; // m: how far the box may move in a tick beyond its speeds at the start
    std::vector<FixedBox> fixed_;
    std::vector<BoxFace> entered_fixed_; // by hand, then by box
    std::array<Memory, hands_max> memory_{};
};

} // namespace hapnet::scene
