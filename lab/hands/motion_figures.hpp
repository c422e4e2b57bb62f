// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/hands/motion.hpp"
#include "proto/base/describe.hpp"

#include <glm/vec3.hpp>
#include <vector>

namespace hapnet::lab::hands {

/// The positions of a motion at figures_rate_hz, metres. The motion is that of a hand, of the
/// middle between two hands, or of one hand as seen from the other.
using Places = std::vector<glm::dvec3>;

/// Twice the highest frequency of a smoothed motion is far below this rate.
inline constexpr double figures_rate_hz = 50.0;

[[nodiscard]] Places sampled(const Motion& motion);

/// Figures of a motion.
struct MotionFigures {
    double spread_x_mm = 0.0;
    double spread_y_mm = 0.0;
    double spread_z_mm = 0.0;
    double speed_mm_s = 0.0;
    double speed_max_mm_s = 0.0;
    double half_power_hz = 0.0;
    double most_power_hz = 0.0;
    double peaks_per_s = 0.0;
    double rest_share = 0.0;

    friend bool operator==(const MotionFigures&, const MotionFigures&) = default;
};
constexpr auto fields_of(base::Tag<MotionFigures>)
{
    using F = MotionFigures;
    return base::fields(
        "motion figures",
        base::member("spread_x_mm", &F::spread_x_mm, "Standard deviation of the position along x.")
            .rounded(3),
        base::member("spread_y_mm", &F::spread_y_mm, "Standard deviation of the position along y.")
            .rounded(3),
        base::member("spread_z_mm", &F::spread_z_mm, "Standard deviation of the position along z.")
            .rounded(3),
        base::member("speed_mm_s", &F::speed_mm_s, "Root mean square of the speed.").rounded(3),
        base::member("speed_max_mm_s", &F::speed_max_mm_s, "Highest speed.").rounded(3),
        base::member("half_power_hz", &F::half_power_hz,
                     "Frequency below which half of the velocity's power is.")
            .rounded(3),
        base::member("most_power_hz", &F::most_power_hz,
                     "Frequency below which 90 % of the velocity's power is.")
            .rounded(3),
        base::member("peaks_per_s", &F::peaks_per_s,
                     "Peaks of the speed a second: fewer are smoother. Peaks below a tenth of the "
                     "speed that is exceeded for 5 % of the time do not count.")
            .rounded(3),
        base::member("rest_share", &F::rest_share,
                     "Share of the time in which the speed is not above that tenth.")
            .rounded(4));
}

/// Returns the figures of a motion of at least three places. The spectrum is Welch's, up to 10 Hz:
/// Hann windows of 4 s that overlap by half or more and reach from end to end, or one window over a
/// shorter motion (Welch, IEEE Trans. Audio Electroacoust. 15, 1967). The number of peaks as a
/// measure of smoothness: Rohrer et al., J. Neurosci. 22, 2002.
[[nodiscard]] MotionFigures figures_of(const Places& places);

} // namespace hapnet::lab::hands
