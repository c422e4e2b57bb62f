// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/solver/block.hpp"

#include <array>
#include <cstdint>

namespace hapnet::scene {

/// Which of the points push.
struct PointSet {
    std::array<std::uint8_t, manifold_points_max> at{};
    std::uint32_t count = 0;

    void add(std::uint32_t point) { at[count++] = static_cast<std::uint8_t>(point); }
};

/// A plane over the tangents through numbers given at three or four points: the numbers' best fit,
/// and for impulses of a given sum and moment those of the least squares.
class PlaneFit {
public:
    PlaneFit(const ContactBlock& block, const PointSet& set) : block_{block}, set_{set}
    {
        for (std::uint32_t i = 0; i < set.count; ++i) {
            middle_1_ += block.along_1[set.at[i]];
            middle_2_ += block.along_2[set.at[i]];
        }
        middle_1_ /= set.count;
        middle_2_ /= set.count;
        for (std::uint32_t i = 0; i < set.count; ++i) {
            const double u = block.along_1[set.at[i]] - middle_1_;
            const double v = block.along_2[set.at[i]] - middle_2_;
            uu_ += u * u;
            uv_ += u * v;
            vv_ += v * v;
        }
        determinant_ = uu_ * vv_ - uv_ * uv_;
    }

    /// Whether the points lie on a line, to rounding.
    [[nodiscard]] bool is_flat() const
    {
        constexpr double thin = 1e-10;
        const double size = uu_ + vv_;
        return !(determinant_ > thin * size * size);
    }

    [[nodiscard]] bool is_along_1() const { return uu_ >= vv_; }

    /// The modal velocity whose normal speeds at the points are `least`.
    [[nodiscard]] std::array<double, 3> modal_least() const
    {
        double mean = 0.0;
        double u_moment = 0.0;
        double v_moment = 0.0;
        for (std::uint32_t i = 0; i < set_.count; ++i) {
            const double value = block_.least[set_.at[i]];
            mean += value;
            u_moment += (block_.along_1[set_.at[i]] - middle_1_) * value;
            v_moment += (block_.along_2[set_.at[i]] - middle_2_) * value;
        }
        mean /= set_.count;
        const auto [u, v] = slope(u_moment, v_moment);
        return {mean - u * middle_1_ - v * middle_2_, v, -u};
    }

    void spread(const std::array<double, 3>& total,
                std::array<double, manifold_points_max>& impulse) const
    {
        const auto [u, v] =
            slope(-total[2] - total[0] * middle_1_, total[1] - total[0] * middle_2_);
        for (std::uint32_t i = 0; i < set_.count; ++i) {
            impulse[set_.at[i]] = total[0] / set_.count +
                                  u * (block_.along_1[set_.at[i]] - middle_1_) +
                                  v * (block_.along_2[set_.at[i]] - middle_2_);
        }
    }

private:
    [[nodiscard]] std::array<double, 2> slope(double u_moment, double v_moment) const
    {
        return {(vv_ * u_moment - uv_ * v_moment) / determinant_,
                (uu_ * v_moment - uv_ * u_moment) / determinant_};
    }

    const ContactBlock& block_;
    const PointSet& set_;
    double middle_1_ = 0.0, middle_2_ = 0.0;
    double uu_ = 0.0, uv_ = 0.0, vv_ = 0.0, determinant_ = 0.0;
};

} // namespace hapnet::scene
