// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/coupled.hpp"

namespace hapnet::scene {

namespace {

using Matrix = std::array<PerAxis, 3>;

/// Returns how the springs couple each pair of moving axes. Springs along an axis count on the
/// diagonal; slanted springs add the products of their normals' components.
Matrix springs_between_axes(const BoxMotion& box)
{
    Matrix sum{};
    const auto moves = [&](std::size_t i) { return box.trajectories[i].moves(); };
    for (std::size_t i = 0; i < 3; ++i) {
        if (moves(i)) sum[i][i] = static_cast<double>(box.spring_counts[i]);
    }
    for (const SlantedSpring& spring : box.active_slanted()) {
        if (spring.phase != SpringPhase::pressing) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                if (moves(i) && moves(j)) sum[i][j] += spring.normal[i] * spring.normal[j];
            }
        }
    }
    return sum;
}

/// Turns the matrix so that its entry (p, q) becomes zero, and turns the basis with it: Jacobi's
/// rotation.
void rotate(Matrix& matrix, Matrix& basis, std::size_t p, std::size_t q)
{
    const double between = matrix[p][q];
    if (between == 0.0) return;
    const double ratio = (matrix[q][q] - matrix[p][p]) / (2.0 * between);
    const double size = 1.0 / (std::abs(ratio) + std::sqrt(ratio * ratio + 1.0));
    const double tangent = ratio < 0.0 ? -size : size;
    const double cosine = 1.0 / std::sqrt(tangent * tangent + 1.0);
    const double sine = tangent * cosine;
    const std::size_t r = 3 - p - q;
    matrix[p][p] -= tangent * between;
    matrix[q][q] += tangent * between;
    matrix[p][q] = matrix[q][p] = 0.0;
    const double at_p = matrix[r][p];
    const double at_q = matrix[r][q];
    matrix[r][p] = matrix[p][r] = cosine * at_p - sine * at_q;
    matrix[r][q] = matrix[q][r] = sine * at_p + cosine * at_q;
    for (std::size_t i = 0; i < 3; ++i) {
        const double was_p = basis[p][i];
        const double was_q = basis[q][i];
        basis[p][i] = cosine * was_p - sine * was_q;
        basis[q][i] = sine * was_p + cosine * was_q;
    }
}

} // namespace

void find_modes(BoxMotion& box)
{
    Matrix matrix = springs_between_axes(box);
    Matrix& basis = box.room.coupled.direction;
    basis = {{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
    constexpr int sweeps = 6; // converges quadratically: four are enough
    for (int i = 0; i < sweeps; ++i) {
        rotate(matrix, basis, 0, 1);
        rotate(matrix, basis, 0, 2);
        rotate(matrix, basis, 1, 2);
    }
    constexpr double rounding = 1e-14;
    const double most = std::max({matrix[0][0], matrix[1][1], matrix[2][2]});
    const Oscillator& spring = box.oscillators.spring();
    const double drag = box.oscillators.of(0, box.is_on_plane).oscillator.damping;
    for (std::size_t j = 0; j < 3; ++j) {
        if (!box.trajectories[j].moves()) continue; // an axis that stays is its own mode
        const double springs = matrix[j][j] > rounding * most ? matrix[j][j] : 0.0;
        const Oscillator oscillator{.damping = springs * spring.damping + drag,
                                    .stiffness = springs * spring.stiffness};
        box.room.coupled.propagators[j] = Propagator{oscillator, box.time_left};
    }
}

void set_modes(BoxMotion& box)
{
    CoupledAxes& coupled = box.room.coupled;
    for (std::size_t j = 0; j < 3; ++j) {
        Trajectory& mode = coupled.modes[j];
        mode = {box.trajectories[j].moves() ? &coupled.propagators[j] : nullptr, 0.0, 0.0, 0.0};
        if (!mode.moves()) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const double share = coupled.direction[j][i];
            mode.speed += share * box.trajectories[i].speed;
            mode.push += share * box.trajectories[i].push;
            mode.ramp += share * box.trajectories[i].ramp;
        }
    }
}

void set_coupled_bounds(BoxMotion& box)
{
    for (AxisMotion& axis : box.axes) {
        axis.acceleration = axis.reach = 0.0;
        axis.bounds = {};
    }
    for (std::size_t j = 0; j < 3; ++j) {
        const Trajectory& mode = box.room.coupled.modes[j];
        if (!mode.moves()) continue;
        const double acceleration = mode.push - mode.propagator->oscillator.damping * mode.speed;
        const double jerk = mode.jerk(acceleration, mode.speed);
        const Bounds most = bounds(*mode.propagator, acceleration, jerk, box.time_left);
        for (std::size_t i = 0; i < 3; ++i) {
            const double share = box.room.coupled.direction[j][i];
            AxisMotion& axis = box.axes[i];
            axis.acceleration += share * acceleration;
            axis.bounds.acceleration += std::abs(share) * most.acceleration;
            axis.bounds.jerk += std::abs(share) * most.jerk;
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        AxisMotion& axis = box.axes[i];
        if (!box.trajectories[i].moves()) continue;
        axis.reach = box.time_left *
                     (std::abs(box.velocity[i]) + 0.5 * box.time_left * axis.bounds.acceleration);
    }
}

RootSearch search_root(const BoxMotion& box, const WatchedQuantity& watched, double from, double to)
{
    if (!box.is_coupled)
        return search_root(watched, box.trajectories, from, to, box.room.root_steps);
    WatchedQuantity in_modes = watched;
    for (std::size_t j = 0; j < 3; ++j) {
        in_modes.displacement_weight[j] =
            dot(box.room.coupled.direction[j], watched.displacement_weight);
        in_modes.speed_weight[j] = dot(box.room.coupled.direction[j], watched.speed_weight);
    }
    return search_root(in_modes, box.room.coupled.modes, from, to, box.room.root_steps);
}

} // namespace hapnet::scene
