// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/plane_contact.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

std::uint32_t PlaneContact::find(const BoxOverPlane& box)
{
    if (!(box.body == corners_.body && box.plane == corners_.plane &&
          box.orientation == corners_.orientation))
        renew(box);
    height_ = box.height;
    touching_ = 0;
    count_ = 0;
    for (std::uint32_t i = 0; i < manifold_points_max; ++i) {
        const double separation = box.height + corners_.rise[i];
        if (separation > box.margin) continue;
        touching_ |= 1U << i;
        separation_[count_++] = separation;
    }
    return count_;
}

bool PlaneContact::lies_on(double within) const
{
    for (std::uint32_t i = 0; i < count_; ++i) {
        if (separation_[i] <= within) return true;
    }
    return false;
}

void PlaneContact::prepare(ContactBlock& block, const ContactMemory& memory)
{
    if (!has_pressure_of(memory)) renew(memory);
    const Pressure& pressure = pressure_;
    block.normal = corners_.normal;
    block.tangent_1 = corners_.tangents.first;
    block.tangent_2 = corners_.tangents.second;
    block.count = pressure.count;
    block.feature = pressure.feature;
    block.along_1 = pressure.along_1;
    block.along_2 = pressure.along_2;
    block.torsion_arm = pressure.torsion_arm;
    set_heights(block);
    block.impulse = pressure.impulse;
    block.start_impulse = pressure.impulse.normal;
    block.start_push = pressure.push;
    block.has_matrix = false;
    block.is_on_plane = true;
}

bool PlaneContact::prepare_again(ContactBlock& block, const ContactMemory& memory) const
{
    if (touching_ == 0 || !has_pressure_of(memory)) return false;
    set_heights(block);
    return true;
}

inline void PlaneContact::set_heights(ContactBlock& block) const
{
    block.separation = separation_;
    // The anchor is midway between the two surfaces.
    block.arm_b = pressure_.across + (0.5 * (pressure_.rise - height_)) * corners_.normal;
    block.arm_a = block.arm_b; // for the plane, which does not move
}

void PlaneContact::renew(const BoxOverPlane& box)
{
    corners_.normal = box.normal;
    corners_.body = box.body;
    corners_.plane = box.plane;
    corners_.orientation = box.orientation;
    corners_.tangents = tangents_of(box.normal);
    const auto corners =
        box.rounding > 0.0
            ? lowest_points(box.normal, {glm::dvec3{0.0}, box.axes, box.half, box.rounding})
            : deepest_corners(box.normal, box.axes, box.half);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners_.rise[i] = corners[i].rise;
        corners_.along_1[i] = glm::dot(corners[i].place, corners_.tangents.first);
        corners_.along_2[i] = glm::dot(corners[i].place, corners_.tangents.second);
        corners_.feature[i] = corners[i].feature;
    }
    pressure_.touching = 0;
}

/// True if all inputs of the pressure are those for which it was found.
bool PlaneContact::has_pressure_of(const ContactMemory& memory) const
{
    const ContactMemory& known = pressure_.memory;
    if (pressure_.touching != touching_ || known.count != memory.count) return false;
    for (std::size_t i = 0; i < manifold_points_max; ++i) {
        if (known.normal_impulse[i] != memory.normal_impulse[i] ||
            known.feature[i] != memory.feature[i])
            return false;
    }
    return known.friction_impulse == memory.friction_impulse &&
           known.torsion_impulse == memory.torsion_impulse;
}

void PlaneContact::renew(const ContactMemory& memory)
{
    Pressure& pressure = pressure_;
    pressure = {.touching = touching_, .count = count_, .memory = memory};
    Each<double> rise{};
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < manifold_points_max; ++i) {
        if ((touching_ >> i & 1U) == 0) continue;
        rise[next] = corners_.rise[i];
        pressure.along_1[next] = corners_.along_1[i];
        pressure.along_2[next] = corners_.along_2[i];
        pressure.feature[next++] = corners_.feature[i];
    }
    pressure.impulse = last_impulse({pressure.feature.data(), count_}, corners_.tangents, memory);
    Each<double> weight = pressure.impulse.normal;
    double sum = weight[0] + weight[1] + weight[2] + weight[3];
    if (!(sum > 0.0)) {
        std::fill_n(weight.begin(), count_, 1.0);
        sum = count_;
    }
    double middle_1 = 0.0, middle_2 = 0.0;
    for (std::uint32_t i = 0; i < count_; ++i) {
        middle_1 += weight[i] * pressure.along_1[i];
        middle_2 += weight[i] * pressure.along_2[i];
        pressure.rise += weight[i] * rise[i];
    }
    middle_1 /= sum;
    middle_2 /= sum;
    pressure.rise /= sum;
    double arm = 0.0;
    for (std::uint32_t i = 0; i < count_; ++i) {
        const double u = pressure.along_1[i] -= middle_1;
        const double v = pressure.along_2[i] -= middle_2;
        arm += std::sqrt(u * u + v * v);
    }
    pressure.torsion_arm = even_pressure * arm / count_;
    pressure.across = middle_1 * corners_.tangents.first + middle_2 * corners_.tangents.second;
    const ContactImpulse& impulse = pressure.impulse;
    const auto& [first, second] = corners_.tangents;
    double normal = 0.0, about_1 = 0.0, about_2 = 0.0;
    for (std::uint32_t i = 0; i < count_; ++i) {
        normal += impulse.normal[i];
        about_1 += pressure.along_2[i] * impulse.normal[i];
        about_2 -= pressure.along_1[i] * impulse.normal[i];
    }
    pressure.push = {normal * corners_.normal + impulse.tangent_1 * first +
                         impulse.tangent_2 * second,
                     about_1 * first + about_2 * second + impulse.torsion * corners_.normal};
}

} // namespace hapnet::scene
