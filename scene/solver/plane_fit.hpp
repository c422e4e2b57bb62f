// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"

#include <array>
#include <cstdint>

namespace hapnet::scene {

/// A number at each point of a contact.
using PointNumbers = std::array<double, manifold_points_max>;

/// The points that push, in their order.
struct PointSet {
    std::array<std::uint8_t, manifold_points_max> at{};
    std::uint16_t count = 0;
    std::uint16_t bits = 0; // one bit for each point

    constexpr void add(std::uint32_t point)
    {
        at[count++] = static_cast<std::uint8_t>(point);
        bits = static_cast<std::uint16_t>(bits | 1U << point);
    }
    [[nodiscard]] static constexpr const PointSet& of(std::uint32_t bits);
};

/// All sets, made at compile time: building one takes a branch for each point.
inline constexpr auto point_sets = [] {
    std::array<PointSet, 1U << manifold_points_max> sets{};
    for (std::uint32_t bits = 0; bits < sets.size(); ++bits) {
        for (std::uint32_t point = 0; point < manifold_points_max; ++point)
            if ((bits >> point & 1U) != 0) sets[bits].add(point);
    }
    return sets;
}();

constexpr const PointSet& PointSet::of(std::uint32_t bits) { return point_sets[bits]; }

/// A plane over the tangents through numbers at three or four points. It is the best fit of the
/// numbers; for impulses of a given sum and moment, it gives the impulses with the least squares.
class PlaneFit {
public:
    PlaneFit() = default;
    PlaneFit(const PointNumbers& along_1, const PointNumbers& along_2, const PointSet& set)
        : set_{set}
    {
        share_ = 1.0 / set.count;
        for (std::uint32_t i = 0; i < set.count; ++i) {
            middle_1_ += along_1[set.at[i]];
            middle_2_ += along_2[set.at[i]];
        }
        middle_1_ *= share_;
        middle_2_ *= share_;
        for (std::uint32_t i = 0; i < set.count; ++i) {
            u_[i] = along_1[set.at[i]] - middle_1_;
            v_[i] = along_2[set.at[i]] - middle_2_;
            uu_ += u_[i] * u_[i];
            uv_ += u_[i] * v_[i];
            vv_ += v_[i] * v_[i];
        }
        determinant_ = uu_ * vv_ - uv_ * uv_;
        if (is_flat()) return;
        const double inverse = 1.0 / determinant_;
        u_by_u_ = vv_ * inverse;
        u_by_v_ = -uv_ * inverse;
        v_by_v_ = uu_ * inverse;
    }

    [[nodiscard]] const PointSet& set() const { return set_; }

    /// True if the points lie on a line, to rounding.
    [[nodiscard]] bool is_flat() const
    {
        constexpr double thin = 1e-10;
        const double size = uu_ + vv_;
        return !(determinant_ > thin * size * size);
    }

    [[nodiscard]] bool is_along_1() const { return uu_ >= vv_; }

    /// Returns the modal velocity whose normal speeds at the points are `least`, or fit them best.
    [[nodiscard]] std::array<double, 3> modal_least(const PointNumbers& least) const
    {
        double mean = 0.0;
        double u_moment = 0.0;
        double v_moment = 0.0;
        for_points([&](std::size_t i, std::size_t at) {
            mean += least[at];
            u_moment += u_[i] * least[at];
            v_moment += v_[i] * least[at];
        });
        mean *= share_;
        const auto [u, v] = slope(u_moment, v_moment);
        return {mean - u * middle_1_ - v * middle_2_, v, -u};
    }

    void spread(const std::array<double, 3>& total, PointNumbers& impulse) const
    {
        const auto slopes =
            slope(-total[2] - total[0] * middle_1_, total[1] - total[0] * middle_2_);
        const double mean = total[0] * share_;
        for_points([&](std::size_t i, std::size_t at) {
            impulse[at] = mean + slopes[0] * u_[i] + slopes[1] * v_[i];
        });
    }

private:
    /// Calls visit(index in the set, index of the point) for the three or four points, in loops of
    /// known lengths.
    template <typename Visit>
    void for_points(Visit visit) const
    {
        if (set_.count == manifold_points_max) {
            for (std::size_t i = 0; i < manifold_points_max; ++i) visit(i, i);
        } else {
            for (std::size_t i = 0; i + 1 < manifold_points_max; ++i) visit(i, set_.at[i]);
        }
    }
    [[nodiscard]] std::array<double, 2> slope(double u_moment, double v_moment) const
    {
        return {u_by_u_ * u_moment + u_by_v_ * v_moment, u_by_v_ * u_moment + v_by_v_ * v_moment};
    }

    PointSet set_;
    PointNumbers u_{}, v_{}; // places of the set's points, from their middle
    double share_ = 0.0;
    double middle_1_ = 0.0, middle_2_ = 0.0;
    double uu_ = 0.0, uv_ = 0.0, vv_ = 0.0, determinant_ = 0.0;
    double u_by_u_ = 0.0, u_by_v_ = 0.0, v_by_v_ = 0.0; // inverse matrix: slopes from moments
};

} // namespace hapnet::scene
