// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/kinematics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>

namespace hapnet::device::falcon {

namespace {

// Stamper's symbols, in metres. Each leg has a frame of its own: u points away from the middle, w
// is parallel to z.
constexpr double a = 0.060;    // the upper arm, from its motor to the knee
constexpr double b = 0.1025;   // the long sides of the parallelogram below it
constexpr double c = 0.01443;  // from the shin's end to the grip's middle, along u
constexpr double d_e = 0.0225; // the short pieces at both ends of the parallelogram, d + e
constexpr double f = -0.025;   // from the shin's end to the grip's middle, along v
constexpr double r = 0.040;    // from the middle of the base to the motor, along u
constexpr double s = -0.02309; // from the middle of the base to the motor, along v

constexpr double pi = 3.14159265358979323846;
constexpr double counts_per_turn = 1280.0; // of the motor, 320 slots with four edges each
constexpr double shaft_over_arm = 14.25 / 110.0;
constexpr double angle_at_zero = 35.0 / 180.0 * pi;
constexpr double angle_per_count = 2.0 * pi / counts_per_turn * shaft_over_arm;

constexpr int iterations_max = 30;
// longer steps may leave the branch that is possible for the legs
constexpr double step_max_m = 0.03;
constexpr double converged_m = 1e-11; // a step of this length ends the iteration
constexpr double angle_error_max = 1e-9;
constexpr double determinant_min = 1e-9; // for unit normals; below it the arm is stretched out

/// The angles of the legs around z: 90, -30 and -150 degrees, all turned by 15.
constexpr std::array<double, 3> azimuths{105.0, -15.0, -135.0};

struct Leg {
    glm::dvec3 u; // axes of the leg's frame
    glm::dvec3 v;
};

const std::array<Leg, 3>& legs()
{
    static const std::array<Leg, 3> all = [] {
        std::array<Leg, 3> made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            const double azimuth = azimuths[i] / 180.0 * pi;
            made[i] = {{std::cos(azimuth), std::sin(azimuth), 0.0},
                       {-std::sin(azimuth), std::cos(azimuth), 0.0}};
        }
        return made;
    }();
    return all;
}

double dot(const glm::dvec3& p, const glm::dvec3& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }

/// Returns a position in a leg's frame, relative to the motor's axle.
glm::dvec3 in_leg(const Leg& leg, const base::Position& grip)
{
    return {dot(leg.u, grip.value) - r, dot(leg.v, grip.value) - s, grip.z() + origin_z_m};
}

/// The constraint by the shin's length, (rho - (d + e))^2 + (v + f)^2 = b^2, where rho is the
/// distance in the u-w plane from the knee to the shin's end: a torus around the knee.
struct Constraint {
    double value;        // 0 where the shin fits
    glm::dvec3 gradient; // derivative by the grip's position, in the common frame
    double by_angle;     // derivative by the leg's angle
};

Constraint constraint_of(const Leg& leg, double angle, const base::Position& grip)
{
    const glm::dvec3 p = in_leg(leg, grip);
    const double sine = std::sin(angle);
    const double cosine = std::cos(angle);
    const double along_u = p.x + c - a * cosine;
    const double along_w = p.z - a * sine;
    const double along_v = p.y + f;
    const double rho = std::hypot(along_u, along_w);
    const double bent = rho - d_e;
    const double share = 2.0 * bent / rho;
    return {bent * bent + along_v * along_v - b * b,
            share * along_u * leg.u + 2.0 * along_v * leg.v + glm::dvec3{0.0, 0.0, share * along_w},
            share * a * (along_u * sine - along_w * cosine)};
}

/// Returns the inverse of the matrix with these rows; nullopt when they are nearly in one plane.
std::optional<glm::dmat3> inverse_of_rows(const std::array<Constraint, 3>& constraints)
{
    glm::dmat3 columns{};
    double lengths = 1.0;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3& gradient = constraints[static_cast<std::size_t>(i)].gradient;
        columns[i] = gradient;
        lengths *= std::sqrt(dot(gradient, gradient));
    }
    const double determinant = glm::determinant(columns);
    if (!(std::abs(determinant) > determinant_min * lengths)) return std::nullopt;
    return glm::inverse(glm::transpose(columns));
}

std::array<Constraint, 3> constraints_at(const Angles& angles, const base::Position& grip)
{
    return {constraint_of(legs()[0], angles[0], grip), constraint_of(legs()[1], angles[1], grip),
            constraint_of(legs()[2], angles[2], grip)};
}

bool gives_back(const base::Position& grip, const Angles& angles)
{
    const auto found = inverse(grip);
    if (!found) return false;
    for (int i = 0; i < 3; ++i) {
        if (!(std::abs((*found)[i] - angles[i]) <= angle_error_max)) return false;
    }
    return true;
}

} // namespace

Angles angles_of(const Counts& encoders)
{
    Angles angles{};
    for (int i = 0; i < 3; ++i) {
        angles[i] = angle_at_zero + angle_per_count * encoders[static_cast<std::size_t>(i)];
    }
    return angles;
}

Counts encoders_at(const Angles& angles)
{
    Counts counts{};
    for (int i = 0; i < 3; ++i) {
        counts[static_cast<std::size_t>(i)] =
            static_cast<std::int16_t>(std::lround((angles[i] - angle_at_zero) / angle_per_count));
    }
    return counts;
}

std::optional<Angles> inverse(const base::Position& grip)
{
    Angles angles{};
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 p = in_leg(legs()[static_cast<std::size_t>(i)], grip);
        const double across = (p.y + f) / b; // Stamper's cosine of theta 3
        if (!(std::abs(across) <= 1.0)) return std::nullopt;
        const double shin = d_e + b * std::sqrt(1.0 - across * across);
        // |knee - shin's end| = shin, with the knee at a (cos, sin) of the angle.
        const double u = p.x + c;
        const double distance = std::hypot(u, p.z);
        const double cosine = (u * u + p.z * p.z + a * a - shin * shin) / (2.0 * a * distance);
        if (!(std::abs(cosine) <= 1.0)) return std::nullopt;
        angles[i] = std::atan2(p.z, u) - std::acos(cosine); // the knee is outside
    }
    return angles;
}

std::optional<base::Position> forward(const Angles& angles, const base::Position& near)
{
    base::Position grip = near;
    for (int i = 0; i < iterations_max; ++i) {
        const auto constraints = constraints_at(angles, grip);
        const auto solver = inverse_of_rows(constraints);
        if (!solver) return std::nullopt;
        base::Displacement step{-(*solver * glm::dvec3{constraints[0].value, constraints[1].value,
                                                       constraints[2].value})};
        grip = grip + base::limited(step, step_max_m);
        if (!base::is_finite(grip)) return std::nullopt;
        if (base::norm(step) > converged_m) continue;
        if (!gives_back(grip, angles)) return std::nullopt;
        return grip;
    }
    return std::nullopt;
}

glm::dmat3 jacobian(const base::Position& grip)
{
    const auto angles = inverse(grip);
    if (!angles) return glm::dmat3{0.0};
    const auto constraints = constraints_at(*angles, grip);
    const auto solver = inverse_of_rows(constraints);
    if (!solver) return glm::dmat3{0.0};
    glm::dmat3 result = *solver;
    for (int i = 0; i < 3; ++i) result[i] *= -constraints[static_cast<std::size_t>(i)].by_angle;
    return result;
}

} // namespace hapnet::device::falcon
