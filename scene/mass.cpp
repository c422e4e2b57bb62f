// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/mass.hpp"

#include "scene/collide/manifold.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace hapnet::scene {

namespace {

glm::dvec3 solid_inertia(double mass_kg, const glm::dvec3& half, double r)
{
    if (r == 0.0) return box_inertia(mass_kg, half);
    const glm::dvec3 core = half - r;
    const double straight = core.x + core.y + core.z; // half the length between the ends
    // The masses are in proportion to the volumes: pi r^2 times these lengths.
    const double share = straight / (straight + 2.0 / 3.0 * r);
    const double cylinder = share * mass_kg;
    const double ends = mass_kg - cylinder;
    const double square = r * r;
    const double along = 0.5 * cylinder * square + 0.4 * ends * square;
    const double across = cylinder * (0.25 * square + straight * straight / 3.0) +
                          ends * (0.4 * square + straight * (straight + 0.75 * r));
    if (straight == 0.0) return glm::dvec3{along};
    return {core.x > 0.0 ? along : across, core.y > 0.0 ? along : across,
            core.z > 0.0 ? along : across};
}

/// A part in the frame of the first, with its share of the mass.
struct Solid {
    glm::dvec3 at{0.0};
    glm::dmat3 axes{1.0};
    glm::dvec3 half{0.0};
    double rounding = 0.0;
    double mass = 0.0;
};

std::vector<Solid> solids_of(const BodyDescription& body)
{
    std::vector<Solid> solids;
    double whole = 0.0;
    const auto add = [&](const PartDescription& part) {
        BodyDescription alone;
        alone.shape = part.shape;
        alone.half = part.half;
        solids.push_back({part.position.value, glm::mat3_cast(base::normalized(part.orientation)),
                          part.half, rounding_of(part), mass_of(alone, 1.0)});
        whole += solids.back().mass;
    };
    add({.shape = body.shape, .half = body.half});
    for (const PartDescription& part : body.parts) add(part);
    for (Solid& solid : solids) solid.mass *= body.mass_kg / whole;
    return solids;
}

/// Rotations that remove the largest products of inertia, one after the other (Jacobi).
class PrincipalAxes {
public:
    explicit PrincipalAxes(const glm::dmat3& tensor) : tensor_{tensor}
    {
        constexpr int turns_max = 60;
        const double trace = tensor[0][0] + tensor[1][1] + tensor[2][2];
        constexpr double rounding = 4e-16;
        for (int turn = 0; turn < turns_max; ++turn) {
            const double xy = std::abs(tensor_[0][1]), yz = std::abs(tensor_[1][2]),
                         zx = std::abs(tensor_[2][0]);
            if (!(std::max({xy, yz, zx}) > rounding * trace)) break;
            if (xy >= yz && xy >= zx) {
                rotate(0, 1);
            } else if (yz >= zx) {
                rotate(1, 2);
            } else {
                rotate(0, 2);
            }
        }
    }
    [[nodiscard]] const glm::dmat3& axes() const { return axes_; }

private:
    void rotate(int p, int q)
    {
        const double theta = (tensor_[q][q] - tensor_[p][p]) / (2.0 * tensor_[p][q]);
        const double tangent =
            std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double cosine = 1.0 / std::sqrt(tangent * tangent + 1.0);
        const double sine = tangent * cosine;
        glm::dmat3 turn{1.0};
        turn[p][p] = turn[q][q] = cosine;
        turn[q][p] = sine;
        turn[p][q] = -sine;
        tensor_ = glm::transpose(turn) * tensor_ * turn;
        tensor_[p][q] = tensor_[q][p] = 0.0;
        axes_ = axes_ * turn;
    }

    glm::dmat3 tensor_;
    glm::dmat3 axes_{1.0};
};

/// The mass of several parts, in the frame of the first one.
struct Whole {
    glm::dvec3 centre{0.0};
    glm::dmat3 axes{1.0};
    glm::dvec3 inertia{0.0}; // about these axes
};

Whole whole_of(const std::vector<Solid>& solids)
{
    Whole whole;
    double mass = 0.0;
    for (const Solid& solid : solids) {
        whole.centre += solid.mass * solid.at;
        mass += solid.mass;
    }
    whole.centre /= mass;
    glm::dmat3 tensor{0.0};
    for (const Solid& solid : solids) {
        const glm::dvec3 about = solid_inertia(solid.mass, solid.half, solid.rounding);
        const glm::dvec3 arm = solid.at - whole.centre;
        const double square = glm::dot(arm, arm);
        for (const int i : {0, 1, 2}) {
            for (const int j : {0, 1, 2}) {
                double sum = solid.mass * ((i == j ? square : 0.0) - arm[i] * arm[j]);
                for (const int k : {0, 1, 2}) sum += solid.axes[k][i] * about[k] * solid.axes[k][j];
                tensor[i][j] += sum;
            }
        }
    }
    whole.axes = PrincipalAxes{tensor}.axes();
    const glm::dmat3 turned = glm::transpose(whole.axes) * tensor * whole.axes;
    whole.inertia = {turned[0][0], turned[1][1], turned[2][2]};
    return whole;
}

} // namespace

MassFrame frame_of_mass(const BodyDescription& body)
{
    if (body.parts.empty()) return {body.position, body.orientation};
    const Whole whole = whole_of(solids_of(body));
    const glm::dquat first = base::normalized(body.orientation);
    return {{body.position.value + first * whole.centre},
            base::normalized(first * glm::quat_cast(whole.axes))};
}

glm::dvec3 inertia_of(const BodyDescription& body)
{
    if (body.parts.empty()) return solid_inertia(body.mass_kg, body.half, rounding_of(body));
    return whole_of(solids_of(body)).inertia;
}

glm::dvec3 box_inertia(double mass_kg, const glm::dvec3& half)
{
    const glm::dvec3 square = half * half;
    return mass_kg / 3.0 *
           glm::dvec3{square.y + square.z, square.z + square.x, square.x + square.y};
}

std::vector<BodyPart> parts_of(const BodyDescription& body)
{
    const std::vector<Solid> solids = solids_of(body);
    const Whole whole = whole_of(solids);
    std::vector<BodyPart> parts;
    for (const Solid& solid : solids) {
        BodyPart part{.at = (solid.at - whole.centre) * whole.axes,
                      .axes = glm::transpose(whole.axes) * solid.axes,
                      .half = solid.half,
                      .rounding = solid.rounding};
        part.radius =
            std::sqrt(glm::dot(part.at, part.at)) + outer_radius(part.half, part.rounding);
        parts.push_back(part);
    }
    return parts;
}

glm::dvec3 half_around(const std::vector<BodyPart>& parts)
{
    glm::dvec3 half{0.0};
    for (const BodyPart& part : parts) {
        const OrientedBox box{glm::dvec3{0.0}, part.axes, part.half, part.rounding};
        for (const int axis : {0, 1, 2}) {
            glm::dvec3 normal{0.0};
            normal[axis] = 1.0;
            half[axis] = std::max(half[axis], std::abs(part.at[axis]) + half_extent(box, normal));
        }
    }
    return half;
}

} // namespace hapnet::scene
