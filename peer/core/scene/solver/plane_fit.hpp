// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/contact/manifold.hpp"

#include <array>
#include <cstdint>

namespace hapnet::scene {

/// A number at each point of a contact.
using PointNumbers = std::array<double, manifold_points_max>;

/// Which of the points push, in their order.
struct PointSet {
    std::array<std::uint8_t, manifold_points_max> at{};
    std::uint32_t count = 0;

    void add(std::uint32_t point) { at[count++] = static_cast<std::uint8_t>(point); }
    /// A bit for each.
    [[nodiscard]] std::uint32_t bits() const
    {
        std::uint32_t sum = 0;
        for (std::uint32_t i = 0; i < count; ++i) sum |= 1U << at[i];
        return sum;
    }
};

/// A plane over the tangents through numbers given at three or four points: the numbers' best fit,
/// and for impulses of a given sum and moment those of the least squares.
class PlaneFit {
public:
    PlaneFit() = default;
    PlaneFit(const PointNumbers& along_1, const PointNumbers& along_2, const PointSet& set)
        : set_{set}
    {
        const double share = 1.0 / set.count;
        for (std::uint32_t i = 0; i < set.count; ++i) {
            middle_1_ += along_1[set.at[i]];
            middle_2_ += along_2[set.at[i]];
        }
        middle_1_ *= share;
        middle_2_ *= share;
        for (std::uint32_t i = 0; i < set.count; ++i) {
            u_[i] = along_1[set.at[i]] - middle_1_;
            v_[i] = along_2[set.at[i]] - middle_2_;
            uu_ += u_[i] * u_[i];
            uv_ += u_[i] * v_[i];
            vv_ += v_[i] * v_[i];
        }
        determinant_ = uu_ * vv_ - uv_ * uv_;
    }

    [[nodiscard]] const PointSet& set() const { return set_; }

    /// Whether the points lie on a line, to rounding.
    [[nodiscard]] bool is_flat() const
    {
        constexpr double thin = 1e-10;
        const double size = uu_ + vv_;
        return !(determinant_ > thin * size * size);
    }

    [[nodiscard]] bool is_along_1() const { return uu_ >= vv_; }

    /// The modal velocity whose normal speeds at the points are `least`.
    [[nodiscard]] std::array<double, 3> modal_least(const PointNumbers& least) const
    {
        double mean = 0.0;
        double u_moment = 0.0;
        double v_moment = 0.0;
        for (std::uint32_t i = 0; i < set_.count; ++i) {
            const double value = least[set_.at[i]];
            mean += value;
            u_moment += u_[i] * value;
            v_moment += v_[i] * value;
        }
        mean /= set_.count;
        const auto [u, v] = slope(u_moment, v_moment);
        return {mean - u * middle_1_ - v * middle_2_, v, -u};
    }

    void spread(const std::array<double, 3>& total, PointNumbers& impulse) const
    {
        const auto [u, v] =
            slope(-total[2] - total[0] * middle_1_, total[1] - total[0] * middle_2_);
        const double mean = total[0] / set_.count;
        for (std::uint32_t i = 0; i < set_.count; ++i) {
            impulse[set_.at[i]] = mean + u * u_[i] + v * v_[i];
        }
    }

private:
    [[nodiscard]] std::array<double, 2> slope(double u_moment, double v_moment) const
    {
        return {(vv_ * u_moment - uv_ * v_moment) / determinant_,
                (uu_ * v_moment - uv_ * u_moment) / determinant_};
    }

    PointSet set_;
    PointNumbers u_{}, v_{}; // of the set's points, from their middle
    double middle_1_ = 0.0, middle_2_ = 0.0;
    double uu_ = 0.0, uv_ = 0.0, vv_ = 0.0, determinant_ = 0.0;
};

} // namespace hapnet::scene
