// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/joints.hpp"

#include "proto/base/math.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace hapnet::scene {

namespace {

// As for contacts: what comes slower than this, times what gravity adds in a tick, stays.
constexpr double least_rebound = 2.0;
// A spring that is shorter than this share of the smallest half edge has no direction.
constexpr double no_length = 1e-9;

// Radians in half a tick.
constexpr double halfway_turn_max = 0.3;

// Of the tick, times the change of spin: how far arms turn on average more than the spin at the
// start says. For a steady change a quarter; ...
constexpr double turning_share = 0.5;

std::uint32_t rows_that_hold(JointKind kind)
{
    switch (kind) {
    case JointKind::hinge:
    case JointKind::slider: return 5;
    case JointKind::ball: return 3;
    case JointKind::spring: break;
    }
    return 0;
}

/// (1 - exp(-2 x)) / (1 + exp(-2 x))
double hyperbolic_tangent(double x)
{
    constexpr double all = 40.0; // it is 1 to the last digit from 20 on
    const double left = base::exp(-2.0 * std::min(x, all));
    return (1.0 - left) / (1.0 + left);
}

/// The angle by which a quaternion turns about a unit axis, from -pi to pi.
double turn_about(const glm::dquat& q, const glm::dvec3& axis)
{
    const double along = glm::dot(glm::dvec3{q.x, q.y, q.z}, axis);
    const double size = std::sqrt(q.w * q.w + along * along);
    if (size == 0.0) return 0.0;
    const glm::dquat twist{q.w / size, along / size, 0.0, 0.0};
    return turn_between({1.0, 0.0, 0.0, 0.0}, twist).x;
}

} // namespace

Joints::Joints(const Description& description, const Bodies& bodies, const Scales& scales)
    : scales_{scales}
{
    JointOrder order = joint_order(description);
    if (order.ids.empty()) return;
    ids_ = std::move(order.ids);
    groups_ = std::move(order.groups);
    stored_.resize(groups_.size());
    memories_.resize(ids_.size());
    arms_.resize(ids_.size());
    stiffened_ = Scratch<Stiffened>{bodies.movable};
    ways_ = Scratch<Way>{bodies.movable};
    way_begins_.resize(groups_.size() + 1);
    for (const JointId id : ids_) joints_.push_back(form_of(description, description.joints[id]));
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        const JointDescription& joint = joints_[i].description;
        if (joint.kind == JointKind::spring)
            memories_[i].coordinate = length(joint.position.value - joint.to_position.value);
    }
    const auto none = static_cast<std::uint32_t>(groups_.size());
    group_of_.assign(bodies.size(), none);
    for (std::uint32_t group = 0; group < groups_.size(); ++group) {
        member_begins_.push_back(static_cast<std::uint32_t>(members_.size()));
        for (std::uint32_t i = groups_[group].begin; i < groups_[group].end; ++i) {
            const JointDescription& joint = joints_[i].description;
            for (const BodyId body : {joint.body, joint.to.value_or(joint.body)}) {
                if (!description.bodies[body].movable || group_of_[body] != none) continue;
                group_of_[body] = group;
                members_.push_back(body);
            }
        }
    }
    member_begins_.push_back(static_cast<std::uint32_t>(members_.size()));
}

std::optional<std::uint32_t> Joints::group_of(BodyId body) const
{
    if (group_of_.empty() || group_of_[body] == groups_.size()) return std::nullopt;
    return group_of_[body];
}

Joints::Form Joints::form_of(const Description& scene, const JointDescription& joint) const
{
    const auto pose = [&](std::optional<std::uint32_t> body) {
        if (!body) return Pose{};
        const MassFrame frame = frame_of_mass(scene.bodies[*body]);
        return Pose{frame.centre.value, frame.orientation};
    };
    const Pose a = pose(joint.to);
    const Pose b = pose(joint.body);
    const bool is_spring = joint.kind == JointKind::spring;
    // A slider is the same wherever it is: it acts at the body's centre.
    const bool is_slider = joint.kind == JointKind::slider;
    const glm::dvec3 at_b = is_slider ? b.centre : joint.position.value;
    const glm::dvec3 at_a = is_spring ? joint.to_position.value : at_b;
    const Tangents across = tangents_of(joint.axis);
    const auto own = [](const Pose& at, const glm::dvec3& v) {
        return glm::conjugate(at.orientation) * v;
    };
    const auto frame = [&](const Pose& at) {
        return Frame{own(at, joint.axis), own(at, across.first), own(at, across.second)};
    };
    Form form;
    form.description = joint;
    form.holding = rows_that_hold(joint.kind);
    form.anchor_a = own(a, at_a - a.centre);
    form.anchor_b = own(b, at_b - b.centre);
    form.frame_a = frame(a);
    form.frame_b = frame(b);
    form.turn = glm::conjugate(glm::conjugate(a.orientation) * b.orientation);
    form.rest = joint.rest.value_or(is_spring ? length(joint.position.value - at_a) : 0.0);
    return form;
}

Joints::Pose Joints::pose_of(const Bodies& bodies, std::optional<BodyId> body)
{
    if (!body) return {};
    const Slot slot = bodies.slot_of[*body];
    return {bodies.position.at(slot), bodies.orientation.at(slot)};
}

/// Where a body will be halfway through the tick if it goes on as it does.
Joints::Pose Joints::halfway(const Bodies& bodies, std::optional<BodyId> body) const
{
    Pose pose = pose_of(bodies, body);
    if (!body || bodies.slot_of[*body] >= bodies.movable) return pose;
    const Slot slot = bodies.slot_of[*body];
    pose.centre += (0.5 * scales_.tick) * bodies.velocity.at(slot);
    // What turns far in a tick is anywhere halfway.
    const glm::dvec3 turn = (0.5 * scales_.tick) * bodies.angular_velocity(slot);
    const double angle = length(turn);
    pose.orientation = rotated(pose.orientation,
                               angle > halfway_turn_max ? (halfway_turn_max / angle) * turn : turn);
    return pose;
}

Joints::Place Joints::place_of(const Form& form, const Pose& a, const Pose& b)
{
    const auto turned = [](const Pose& by, const Frame& frame) {
        return Frame{by.orientation * frame.axis, by.orientation * frame.across,
                     by.orientation * frame.aside};
    };
    Place place;
    place.arm_a = a.orientation * form.anchor_a;
    place.arm_b = b.orientation * form.anchor_b;
    place.way = (b.centre - a.centre) + (place.arm_b - place.arm_a);
    place.a = turned(a, form.frame_a);
    place.b = turned(b, form.frame_b);
    place.turn = glm::conjugate(a.orientation) * b.orientation * form.turn;
    return place;
}

/// The directions in which the joint acts.
void Joints::set_rows(JointBlock& block, const Form& form, const Place& place)
{
    std::uint32_t count = 0;
    // What pushes along a direction that turns with a acts on both at b's anchor.
    const auto along = [&](const glm::dvec3& direction, const glm::dvec3& arm_a) {
        JointRow& row = block.rows[count++];
        row.linear = direction;
        row.angular_a = -glm::cross(arm_a, direction);
        row.angular_b = glm::cross(place.arm_b, direction);
    };
    const auto about = [&](const glm::dvec3& axis) {
        JointRow& row = block.rows[count++];
        row.linear = glm::dvec3{0.0};
        row.angular_a = -axis;
        row.angular_b = axis;
    };
    const glm::dvec3 far_arm = place.arm_a + place.way;
    switch (form.description.kind) {
    case JointKind::hinge:
    case JointKind::ball:
        for (const int axis : {0, 1, 2}) along(axis_of_world(axis), place.arm_a);
        break;
    case JointKind::slider:
        along(place.a.across, far_arm);
        along(place.a.aside, far_arm);
        about(glm::cross(place.b.across, place.a.aside));
        break;
    case JointKind::spring: break;
    }
    const bool has_axis = form.holding == 5;
    if (has_axis) {
        about(glm::cross(place.b.axis, place.a.across));
        about(glm::cross(place.b.axis, place.a.aside));
    }
    const auto free = [&](double sign) {
        if (form.description.kind == JointKind::hinge) about(sign * place.a.axis);
        if (form.description.kind == JointKind::slider) along(sign * place.a.axis, far_arm);
        if (form.description.kind != JointKind::spring) return;
        if (form.pulls_to_point() && form.description.stiffness > 0.0) {
            for (const int axis : {0, 1, 2}) along(axis_of_world(axis), place.arm_a);
        }
        if (form.pulls_to_point() && form.description.damping == 0.0) return;
        const double size = length(place.way);
        along(size > 0.0 ? place.way / size : glm::dvec3{0.0}, place.arm_a);
    };
    if (form.has_spring()) free(1.0);
    if (form.description.lowest) free(1.0);
    if (form.description.highest) free(-1.0);
    block.count = count;
}

/// By how much the joint is off in a row that holds, m or rad.
double Joints::miss_of(const Form& form, const Place& place, std::uint32_t row)
{
    const auto turn = [&](std::uint32_t which) {
        return glm::dot(place.b.axis, which == 0 ? place.a.across : place.a.aside);
    };
    if (form.description.kind == JointKind::slider) {
        if (row == 0) return glm::dot(place.a.across, place.way);
        if (row == 1) return glm::dot(place.a.aside, place.way);
        if (row == 2) return glm::dot(place.b.across, place.a.aside);
        return turn(row - 3);
    }
    return row < 3 ? place.way[static_cast<int>(row)] : turn(row - 3);
}

/// A hinge may turn many times: its angle is the one next to `last`.
double Joints::coordinate_of(const Form& form, const Place& place, double last)
{
    switch (form.description.kind) {
    case JointKind::slider: return glm::dot(place.a.axis, place.way);
    case JointKind::hinge: {
        const double angle = turn_about(place.turn, form.frame_a.axis);
        return angle + base::two_pi * std::floor((last - angle) / base::two_pi + 0.5);
    }
    case JointKind::spring: return length(place.way);
    case JointKind::ball: break;
    }
    return 0.0;
}

double Joints::energy_of(std::size_t index, double coordinate) const
{
    const double bend = coordinate - joints_[index].rest;
    return 0.5 * joints_[index].description.stiffness * bend * bend;
}

/// The force of the mean velocity over the tick: stiffness at the bend halfway, and a damper, no
/// stronger than one that stops what it damps within the tick (to the second order alike).
void Joints::set_spring(JointRow& row, const Pull& pull, double speed, double response) const
{
    const double tick = scales_.tick;
    double damping = pull.damping;
    if (damping > 0.0 && response > 0.0) {
        const double stops = 2.0 / (tick * response);
        damping = stops * hyperbolic_tangent(damping / stops);
    }
    const double rate = 0.5 * tick * (0.5 * tick * pull.stiffness + damping); // N s for 1 m/s
    row.compliance = 1.0 / rate;
    row.target = -speed - tick * pull.stiffness * pull.bend / rate;
}

/// The coordinate's end of tick is within the limit, if it goes on with the mean of its speeds; and
/// no limit makes faster what leaves it.
void Joints::set_limit(JointRow& row, const Form& form, double gap, double speed) const
{
    row.pushes_only = true;
    row.target = std::min(0.0, -2.0 * gap * scales_.rate - speed);
    const double bounces_from = least_rebound * scales_.fall / row.arm;
    const double restitution = form.description.restitution;
    if (restitution > 0.0 && -speed > bounces_from && gap + scales_.tick * speed <= 0.0)
        row.target = -restitution * speed;
}

void Joints::begin_contacts(const Bodies& bodies, ContactSolver& solver) const
{
    for (JointSolver::Group& group : solver.joints().groups()) {
        const std::size_t index =
            static_cast<std::size_t>(&group - solver.joints().groups().data());
        group.is_awake = bodies.slot_of[bodies_of(index)[0]] < bodies.awake;
    }
}

void Joints::begin_tick(const WorldState& state, ContactSolver& solver)
{
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const JointSolver::Group& group = solver.joints().groups()[g];
        stored_[g] = {};
        if (!group.is_awake) continue;
        for (std::uint32_t i = group.begin; i < group.end; ++i) {
            begin_joint(i, state.bodies, solver);
            stored_[g].before += energy_of(i, memories_[i].coordinate);
        }
    }
}

/// The rows of one joint.
void Joints::begin_joint(std::uint32_t i, const Bodies& bodies, ContactSolver& solver)
{
    const Form& form = joints_[i];
    const auto index_of = [&](std::optional<BodyId> body) -> SolverIndex {
        if (!body) return 0;
        const Slot slot = bodies.slot_of[*body];
        return slot < bodies.awake ? slot + 1 : 0;
    };
    const auto motion_of = [&](SolverIndex index) {
        if (index == 0) return BodyMotion{};
        return BodyMotion{bodies.velocity.at(index - 1), bodies.angular_velocity(index - 1),
                          glm::dvec3{0.0}};
    };
    const std::optional<BodyId> other = form.description.to;
    const BodyId body = form.description.body;
    JointBlock& block = solver.joints().joint(i);
    block.a = index_of(other);
    block.b = index_of(body);
    const BodyMotion a = motion_of(block.a);
    const BodyMotion b = motion_of(block.b);
    const Place start = place_of(form, pose_of(bodies, other), pose_of(bodies, body));
    const Place middle = place_of(form, halfway(bodies, other), halfway(bodies, body));
    set_rows(block, form, start);
    std::array<double, JointBlock::rows_max> at_start{};
    for (std::uint32_t k = 0; k < form.holding; ++k)
        at_start[k] = row_velocity(block, block.rows[k], a, b);
    set_rows(block, form, middle);
    const bool is_slider = form.description.kind == JointKind::slider;
    arms_[i] = {is_slider ? middle.arm_a + middle.way : middle.arm_a, middle.arm_b};
    Memory& memory = memories_[i];
    memory.coordinate = coordinate_of(form, start, memory.coordinate);
    const bool is_spring = form.description.kind == JointKind::spring;
    if (is_spring && length(middle.way) <= no_length * scales_.least && !form.pulls_to_point())
        block.count = 0;
    for (std::uint32_t k = 0; k < block.count; ++k) {
        JointRow& row = block.rows[k];
        const double speed = row_velocity(block, row, a, b);
        row.compliance = 0.0;
        row.pushes_only = false;
        row.arm = row.linear == glm::dvec3{0.0} ? scales_.size : 1.0;
        row.impulse = memory.impulse[k];
        row.way_impulse = 0.0;
        row.corrects_way = false;
        if (k < form.holding) {
            row.target = at_start[k] - speed;
        } else if (k < form.limits_begin()) {
            set_spring(
                row, pull_of(form, start, middle, k - form.holding, memory.coordinate), speed,
                row_response(block, row, solver.response(block.a), solver.response(block.b)));
        } else {
            const bool is_lowest = form.description.lowest && k == form.limits_begin();
            set_limit(row, form,
                      is_lowest ? memory.coordinate - *form.description.lowest
                                : *form.description.highest - memory.coordinate,
                      speed);
        }
    }
}

Joints::Pull Joints::pull_of(const Form& form, const Place& start, const Place& middle,
                             std::uint32_t row, double coordinate)
{
    const JointDescription& joint = form.description;
    if (form.pulls_to_point()) {
        if (joint.stiffness > 0.0 && row < 3)
            return {joint.stiffness, 0.0, start.way[static_cast<int>(row)]};
        return {0.0, joint.damping, 0.0};
    }
    // A spring that goes through its own end within the tick is turned round halfway.
    const bool is_turned = joint.kind == JointKind::spring && glm::dot(start.way, middle.way) < 0.0;
    return {joint.stiffness, joint.damping, (is_turned ? -coordinate : coordinate) - form.rest};
}

void Joints::warm_start(ContactSolver& solver, std::span<BodyIntegration> integrations) const
{
    JointSolver& joints = solver.joints();
    for (const JointSolver::Group& group : joints.groups()) {
        if (!group.is_awake) continue;
        for (const JointBlock& block : joints.joints_of(group)) {
            for (std::uint32_t k = 0; k < block.count; ++k) {
                const JointRow& row = block.rows[k];
                if (block.b != 0) {
                    integrations[block.b].contact_impulse += row.impulse * row.linear;
                    integrations[block.b].contact_angular_impulse += row.impulse * row.angular_b;
                }
                if (block.a != 0) {
                    integrations[block.a].contact_impulse -= row.impulse * row.linear;
                    integrations[block.a].contact_angular_impulse += row.impulse * row.angular_a;
                }
            }
        }
    }
}

void Joints::stiffen(const Bodies& bodies, ContactSolver& solver,
                     std::span<BodyIntegration> integrations)
{
    JointSolver& joints = solver.joints();
    stiffened_.clear();
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const JointSolver::Group& group = joints.groups()[g];
        if (!group.is_awake) continue;
        for (const BodyId id : bodies_of(g)) {
            const Slot slot = bodies.slot_of[id];
            const SolverIndex body = slot + 1;
            BodyIntegration& integration = integrations[body];
            // What hands do counts on the body's own inertia.
            if (integration.has_hands || bodies.properties[slot].turning != Turning::free) continue;
            glm::dmat3 more{0.0};
            glm::dvec3 twist{0.0}; // N m s, of last tick's impulses
            for (std::uint32_t i = group.begin; i < group.end; ++i) {
                const JointBlock& block = joints.joint(i);
                if (block.a != body && block.b != body) continue;
                const bool is_a = block.a == body;
                glm::dvec3 pull{0.0};
                for (std::uint32_t k = 0; k < block.count; ++k) {
                    const JointRow& row = block.rows[k];
                    pull += (is_a ? -row.impulse : row.impulse) * row.linear;
                    twist += row.impulse * (is_a ? row.angular_a : row.angular_b);
                }
                const glm::dvec3& arm = is_a ? arms_[i].a : arms_[i].b;
                const double taut = glm::dot(arm, pull);
                if (!(taut > 0.0)) continue;
                more += taut * (glm::dmat3{1.0} - glm::outerProduct(arm, arm) / glm::dot(arm, arm));
            }
            if (more == glm::dmat3{0.0}) continue;
            BodyResponse& response = solver.response(body);
            Stiffened& its = stiffened_.add();
            its = {body, glm::inverse(response.inverse_inertia), response.inverse_inertia,
                   integration.predicted.spin};
            response.inverse_inertia =
                glm::inverse(its.inertia + (turning_share * scales_.tick) * more);
            const glm::dvec3 less = response.inverse_inertia * twist - its.inverse_inertia * twist;
            integration.predicted.spin += less;
            integration.mean.spin += 0.5 * less;
        }
    }
}

void Joints::soften(ContactSolver& solver)
{
    for (const Stiffened& its : stiffened_.all()) {
        solver.response(its.body).inverse_inertia = its.inverse_inertia;
        BodyMotion& end = solver.end_motion(its.body);
        end.angular_impulse = its.inertia * (end.spin - its.spin);
    }
    for (ContactBlock& block : solver.blocks()) block.has_matrix = false;
}

void Joints::store_impulses(WorldState& state, ContactSolver& solver)
{
    JointSolver& joints = solver.joints();
    for (const JointSolver::Group& group : joints.groups()) {
        if (!group.is_awake) continue;
        for (std::uint32_t i = group.begin; i < group.end; ++i) {
            const JointBlock& block = joints.joint(i);
            glm::dvec3 push{0.0};
            glm::dvec3 twist{0.0};
            for (std::uint32_t k = 0; k < block.count; ++k) {
                const JointRow& row = block.rows[k];
                push += row.impulse * row.linear;
                if (row.linear == glm::dvec3{0.0}) twist += row.impulse * row.angular_b;
                // Those of a blow will not come again: see store_impulses() of a contact.
                const double response =
                    row_response(block, row, solver.response(block.a), solver.response(block.b));
                const double weight = response > 0.0 ? scales_.speed / (row.arm * response) : 0.0;
                const double most = 2.0 * std::abs(memories_[i].impulse[k]) + weight;
                memories_[i].impulse[k] = std::clamp(row.impulse, -most, most);
            }
            state.joints[ids_[i]].force.value = scales_.rate * push;
            state.joints[ids_[i]].torque = scales_.rate * twist;
        }
    }
}

void Joints::end_tick(WorldState& state, const JointSolver& joints)
{
    for (std::size_t g = 0; g < groups_.size(); ++g)
        if (joints.groups()[g].is_awake) read_places(state, g);
}

void Joints::on_placed(WorldState& state, BodyId body) const
{
    const std::optional<std::uint32_t> group = group_of(body);
    if (!group) return;
    for (std::uint32_t i = groups_[*group].begin; i < groups_[*group].end; ++i) {
        const JointDescription& joint = joints_[i].description;
        const Place now = place_of(joints_[i], pose_of(state.bodies, joint.to),
                                   pose_of(state.bodies, joint.body));
        state.joints[ids_[i]].coordinate = coordinate_of(joints_[i], now, memories_[i].coordinate);
    }
}

void Joints::read_places(WorldState& state, std::size_t group)
{
    const Bodies& bodies = state.bodies;
    stored_[group].after = 0.0;
    for (std::uint32_t i = groups_[group].begin; i < groups_[group].end; ++i) {
        const Form& form = joints_[i];
        const Place end = place_of(form, pose_of(bodies, form.description.to),
                                   pose_of(bodies, form.description.body));
        JointState& its = state.joints[ids_[i]];
        its.coordinate = coordinate_of(form, end, memories_[i].coordinate);
        its.rate = scales_.rate * (its.coordinate - memories_[i].coordinate);
        stored_[group].after += energy_of(i, its.coordinate);
    }
}

bool Joints::keeps_energy(const JointSolver& joints, std::size_t group) const
{
    for (std::uint32_t i = groups_[group].begin; i < groups_[group].end; ++i) {
        if (joints_[i].description.damping > 0.0) return false;
        const JointBlock& block = joints.joint(i);
        for (std::uint32_t k = 0; k < block.count; ++k)
            if (block.rows[k].pushes_only && block.rows[k].impulse > 0.0) return false;
    }
    return true;
}

} // namespace hapnet::scene
