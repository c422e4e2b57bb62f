// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/maths/vector.hpp"
#include "scene/state.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace hapnet::scene {

/// The region that one fixed box or plane closes to a box's centre: the obstacle, grown by the half
/// edges of the box. The region of a plane reaches to infinity in all directions but one.
struct Obstacle {
    PerAxis low{};
    PerAxis high{};
    Material material{}; // combined material of the obstacle and the box
    bool is_plane = false;
    std::size_t normal_axis = 0; // axis of the normal, if it is a plane

    /// Returns the distance along an axis of a centre outside the region; < 0: between its two
    /// faces.
    [[nodiscard]] double gap(std::size_t axis, double place) const
    {
        return std::max(low[axis] - place, place - high[axis]);
    }
    /// Returns +1 when the centre is nearer to the high face, else -1.
    [[nodiscard]] double side(std::size_t axis, double place) const
    {
        return place - high[axis] >= low[axis] - place ? 1.0 : -1.0;
    }
    [[nodiscard]] double face(std::size_t axis, double side) const
    {
        return side > 0.0 ? high[axis] : low[axis];
    }
};

/// All obstacles of one movable box. Near ones are kept in a list, in the order of the description.
/// The others are examined again when the box has moved far enough.
class Obstacles {
public:
    Obstacles(const WorldConfig& config, const Bodies& bodies, const BodyProperties& movable);

    /// Returns how far the centre may still move before the list of near obstacles has to be made
    /// again.
    [[nodiscard]] double clearance(const PerAxis& centre) const
    {
        const double x = std::abs(centre[0] - query_centre_[0]);
        const double y = std::abs(centre[1] - query_centre_[1]);
        const double z = std::abs(centre[2] - query_centre_[2]);
        return margin_ - std::max(std::max(x, y), z);
    }
    /// Returns at least the obstacles within `reach` of the centre, along every axis.
    [[nodiscard]] std::span<const std::uint32_t> nearby(const PerAxis& centre, double reach)
    {
        if (!(reach <= clearance(centre))) refresh(centre, reach);
        return {nearby_.begin(), nearby_.size()};
    }
    [[nodiscard]] const Obstacle& operator[](std::uint32_t index) const { return all_[index]; }

    /// Moves the centre out of every obstacle that it is in: to the obstacle's nearest face, along
    /// an axis that is not locked. Returns true if the centre was in an obstacle.
    bool push_out(std::span<const std::uint32_t> of_those, PerAxis& centre) const;

private:
    void refresh(const PerAxis& centre, double reach);

    std::vector<Obstacle> all_;
    Bounded<std::uint32_t> nearby_;
    std::array<bool, 3> locked_{};
    PerAxis query_centre_{};
    double default_margin_ = 0.0;
    double margin_ = -1.0; // nearby_ omits obstacles that are farther than this from query_centre_
};

} // namespace hapnet::scene
