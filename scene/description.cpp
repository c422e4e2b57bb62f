// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/description.hpp"

#include "proto/base/math.hpp"

#include <bit>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::scene {

namespace {

/// Checks one part of a description and keeps the first error.
class Check {
public:
    explicit Check(std::string part) : part_{std::move(part)} {}

    void within(std::string_view what, double value, double least, double most)
    {
        if (value >= least && value <= most) return; // false for NaN
        complain(fmt::format("{} is {}; it can be {} to {}", what, value, least, most));
    }
    void within(std::string_view what, const glm::dvec3& value, double least, double most)
    {
        for (const int axis : {0, 1, 2}) within(what, value[axis], least, most);
    }
    void holds(bool condition, std::string_view otherwise)
    {
        if (!condition) complain(std::string{otherwise});
    }
    [[nodiscard]] base::Result<void> result() const
    {
        if (complaint_.empty()) return {};
        return base::fail(part_ + ": " + complaint_);
    }

private:
    void complain(std::string complaint)
    {
        if (complaint_.empty()) complaint_ = std::move(complaint);
    }

    std::string part_;
    std::string complaint_;
};

bool is_unit(double square)
{
    constexpr double tolerance = 1e-6; // a person may write no more than seven digits
    return std::abs(square - 1.0) <= tolerance;
}

double square(const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }
double square(const glm::dquat& q) { return q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z; }

double shortest(const glm::dvec3& half) { return std::min(half.x, std::min(half.y, half.z)); }

void check_material(Check& check, const Material& material)
{
    check.within("friction", material.friction, 0.0, friction_max);
    check.within("restitution", material.restitution, 0.0, 1.0);
}

void check_sway(Check& check, const Sway& sway)
{
    check.within("sway in m", sway.by, -reach_max_m, reach_max_m);
    if (sway.period == base::Duration{}) {
        check.holds(sway.by == glm::dvec3{0.0}, "sway needs a sway_period");
        return;
    }
    check.within("sway_period in s", base::to_seconds(sway.period), base::to_seconds(period_min),
                 base::to_seconds(period_max));
    const double fastest =
        0.5 * base::two_pi / base::to_seconds(sway.period) * std::sqrt(square(sway.by));
    check.holds(fastest <= speed_max_m_per_s,
                fmt::format("sways faster than {} m/s", speed_max_m_per_s));
}

void check_feel(Check& check, const Feel& feel)
{
    check.within("stiffness in N/m", feel.stiffness_n_per_m.value_or(0.0), 0.0,
                 stiffness_max_n_per_m);
    check.within("damping in N s/m", feel.damping_ns_per_m.value_or(0.0), 0.0,
                 damping_max_ns_per_m);
    check.within("static_friction", feel.static_friction.value_or(0.0), 0.0, friction_max);
    check.within("dynamic_friction", feel.dynamic_friction.value_or(0.0), 0.0, friction_max);
    if (feel.static_friction && feel.dynamic_friction) {
        check.holds(*feel.dynamic_friction <= *feel.static_friction,
                    "dynamic_friction is above static_friction");
    }
}

void check_shape(Check& check, Shape shape, const glm::dvec3& half)
{
    check.within("half an edge in m", half, size_min_m, size_max_m);
    const double least = shortest(half);
    const int at_least = int{half.x == least} + int{half.y == least} + int{half.z == least};
    if (shape == Shape::sphere)
        check.holds(at_least == 3, "the three edges around a sphere are equal");
    if (shape == Shape::capsule)
        check.holds(at_least == 2, "two of the edges around a capsule are equal, and the third is "
                                   "longer");
}

void check_parts(Check& check, const BodyDescription& body)
{
    check.holds(body.parts.size() <= parts_max,
                fmt::format("more than {} further parts", parts_max));
    for (const PartDescription& part : body.parts) {
        check_shape(check, part.shape, part.half);
        check.within("position of a part in m", part.position.value, -size_max_m, size_max_m);
        check.holds(is_unit(square(part.orientation)),
                    "orientation of a part is not a unit quaternion");
    }
}

base::Result<void> check_body(const BodyDescription& body, std::size_t number)
{
    Check check{fmt::format("body {} '{}'", number, body.name)};
    check_shape(check, body.shape, body.half);
    check_parts(check, body);
    check.within("position in m", body.position.value, -reach_max_m, reach_max_m);
    check.holds(is_unit(square(body.orientation)), "orientation is not a unit quaternion");
    check_material(check, body.material);
    check.within("drag in N s/m", body.drag_ns_per_m, 0.0, damping_max_ns_per_m);
    check_feel(check, body.feel);
    check.holds(!(body.kinematic && body.movable), "a kinematic body is not movable");
    if (!body.movable && !body.kinematic) return check.result();
    if (body.movable) check.within("mass in kg", body.mass_kg, mass_min_kg, mass_max_kg);
    if (body.kinematic) {
        check_sway(check, body.sway);
        check.holds(body.sway.period == base::Duration{} || body.velocity.value == glm::dvec3{0.0},
                    "a body that sways has no velocity of its own");
    }
    check.within("velocity in m/s", body.velocity.value, -speed_max_m_per_s, speed_max_m_per_s);
    check.within("angular velocity in rad/s", body.angular_velocity, -turn_max_rad_per_s,
                 turn_max_rad_per_s);
    return check.result();
}

base::Result<void> check_plane(const PlaneDescription& plane, std::size_t number)
{
    Check check{fmt::format("plane {} '{}'", number, plane.name)};
    check.holds(is_unit(square(plane.normal)), "normal is not of length 1");
    check.within("offset in m", plane.offset_m, -reach_max_m, reach_max_m);
    check_material(check, plane.material);
    return check.result();
}

base::Result<void> check_field(const FieldDescription& field, std::size_t number)
{
    Check check{fmt::format("field {} '{}'", number, field.name)};
    check.within("position in m", field.position.value, -reach_max_m, reach_max_m);
    if (field.half) check.within("half an edge in m", *field.half, size_min_m, reach_max_m);
    check.within("force in N", field.force.value, -force_max_n, force_max_n);
    check.within("damping in N s/m", field.damping_ns_per_m, 0.0, damping_max_ns_per_m);
    check.within("stiffness in N/m", field.stiffness_n_per_m, 0.0, stiffness_max_n_per_m);
    if (field.line) check.holds(is_unit(square(*field.line)), "line is not of length 1");
    check.holds(field.force_limit_n >= 0.0, "force_max is below 0");
    return check.result();
}

base::Result<void> check_whole(const Description& description)
{
    Check check{"scene"};
    check.holds(description.bodies.size() <= bodies_max,
                fmt::format("more than {} bodies", bodies_max));
    check.holds(description.planes.size() <= planes_max,
                fmt::format("more than {} planes", planes_max));
    check.holds(description.fields.size() <= fields_max,
                fmt::format("more than {} fields", fields_max));
    check.within("gravity in m/s^2", description.gravity, -gravity_max_m_per_s2,
                 gravity_max_m_per_s2);
    return check.result();
}

base::Result<void> check_own_hands(const Description& description)
{
    Check check{"hands"};
    check.holds(description.own_hands.size() <= description.hands.count,
                fmt::format("[[hand]] {} times for a count of {}", description.own_hands.size(),
                            description.hands.count));
    for (const Feel& feel : description.own_hands) check_feel(check, feel);
    return check.result();
}

base::Result<void> check_hands(const HandDescription& hands)
{
    Check check{"hips"};
    check.holds(hands.count <= hands_max, fmt::format("count is more than {}", hands_max));
    check.within("radius in m", hands.radius_m, size_min_m, size_max_m);
    check.within("stiffness in N/m", hands.stiffness_n_per_m, 0.0, stiffness_max_n_per_m);
    check.within("damping in N s/m", hands.damping_ns_per_m, 0.0, damping_max_ns_per_m);
    check.within("grip reach in m", hands.grip_reach_m, 0.0, size_max_m);
    check.within("friction", hands.friction, 0.0, friction_max);
    check.within("static_friction", hands.static_friction, 0.0, friction_max);
    check.within("dynamic_friction", hands.dynamic_friction.value_or(0.0), 0.0,
                 hands.static_friction);
    check.holds(std::isinf(hands.force_max_n) || hands.force_max_n <= force_max_n,
                fmt::format("force_max is more than {} N; infinity: no limit", force_max_n));
    check.holds(hands.force_max_n >= 0.0, "force_max is below 0");
    return check.result();
}

/// FNV-1a over the bits of every number.
class Hash {
public:
    void add(std::uint64_t bits)
    {
        for (unsigned shift = 0; shift < 64; shift += 8) {
            hash_ ^= (bits >> shift) & 0xffU;
            hash_ *= 0x100000001b3U;
        }
    }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); } // -0 counts as 0
    void add(const glm::dvec3& v)
    {
        for (const int axis : {0, 1, 2}) add(v[axis]);
    }
    void add(const Material& material)
    {
        add(material.friction);
        add(material.restitution);
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325U;
};

void add(Hash& hash, const BodyDescription& body)
{
    const auto flags = (body.movable ? 1U : 0U) | (body.kinematic ? 128U : 0U) |
                       (body.locked.x ? 2U : 0U) | (body.locked.y ? 4U : 0U) |
                       (body.locked.z ? 8U : 0U) | static_cast<unsigned>(body.turning) << 4U;
    hash.add(std::uint64_t{flags});
    hash.add(body.half);
    hash.add(body.position.value);
    for (const double part :
         {body.orientation.w, body.orientation.x, body.orientation.y, body.orientation.z}) {
        hash.add(part);
    }
    hash.add(body.material);
    hash.add(body.drag_ns_per_m);
    if (!body.movable && !body.kinematic) return;
    hash.add(body.velocity.value);
    hash.add(body.angular_velocity);
    if (body.movable) return hash.add(body.mass_kg);
    hash.add(body.sway.by);
    hash.add(base::to_seconds(body.sway.period));
}

/// Adds nothing for a scene without parts, so that its hash does not depend on them.
void add_parts(Hash& hash, const Description& description)
{
    constexpr std::uint64_t part_mark = 0x70617274;
    for (std::size_t i = 0; i < description.bodies.size(); ++i) {
        for (const PartDescription& part : description.bodies[i].parts) {
            hash.add(part_mark + i);
            hash.add(std::uint64_t{static_cast<unsigned>(part.shape)});
            hash.add(part.half);
            hash.add(part.position.value);
            const glm::dquat& q = part.orientation;
            for (const double number : {q.w, q.x, q.y, q.z}) hash.add(number);
        }
    }
}

/// Adds nothing for a scene whose hands have no friction, so that its hash does not depend on it.
void add_hand_friction(Hash& hash, const Description& description)
{
    constexpr double unset = -1.0;
    const HandDescription& hands = description.hands;
    if (hands.static_friction != 0.0) {
        hash.add(hands.static_friction);
        hash.add(hands.dynamic_friction.value_or(unset));
    }
    constexpr std::uint64_t hand_mark = 0x68616e64, body_mark = 0x626f6479;
    const auto add_own = [&](std::uint64_t mark, const Feel& feel) {
        if (!feel.has_own_friction()) return;
        hash.add(mark);
        hash.add(feel.static_friction.value_or(unset));
        hash.add(feel.dynamic_friction.value_or(unset));
    };
    for (std::size_t i = 0; i < description.own_hands.size(); ++i)
        add_own(hand_mark + i, description.own_hands[i]);
    for (std::size_t i = 0; i < description.bodies.size(); ++i)
        add_own(body_mark + i, description.bodies[i].feel);
}

} // namespace

double rounding_of(const BodyDescription& body)
{
    return body.shape == Shape::box ? 0.0 : shortest(body.half);
}

double rounding_of(const PartDescription& part)
{
    return part.shape == Shape::box ? 0.0 : shortest(part.half);
}

double mass_of(const BodyDescription& body, double density)
{
    const auto mass = [density](const auto& solid) {
        const double radius = rounding_of(solid);
        const glm::dvec3& half = solid.half;
        if (radius == 0.0) return density * 8.0 * half.x * half.y * half.z;
        const double straight = half.x + half.y + half.z - 3.0 * radius; // half its length
        return density * base::two_pi * radius * radius * (straight + 2.0 / 3.0 * radius);
    };
    double sum = mass(body);
    for (const PartDescription& part : body.parts) sum += mass(part);
    return sum;
}

HandDescription hand_on(const HandDescription& hands, const Feel& own_hand, const Feel& body)
{
    HandDescription hand = hands;
    for (const Feel* feel : {&own_hand, &body}) {
        hand.stiffness_n_per_m = feel->stiffness_n_per_m.value_or(hand.stiffness_n_per_m);
        hand.damping_ns_per_m = feel->damping_ns_per_m.value_or(hand.damping_ns_per_m);
    }
    return hand;
}

HandFriction friction_of(const HandDescription& hands, const Feel& own_hand)
{
    const double sticking = own_hand.static_friction.value_or(hands.static_friction);
    const std::optional<double> sliding =
        own_hand.has_own_friction() ? own_hand.dynamic_friction : hands.dynamic_friction;
    return {sticking, std::min(sliding.value_or(sticking), sticking)};
}

HandFriction friction_of(const Material& surface, const Feel& own)
{
    const double sticking = own.static_friction.value_or(surface.friction);
    return {sticking, std::min(own.dynamic_friction.value_or(sticking), sticking)};
}

base::Result<void> check(const Description& description)
{
    if (auto whole = check_whole(description); !whole) return whole;
    if (auto hands = check_hands(description.hands); !hands) return hands;
    if (auto own = check_own_hands(description); !own) return own;
    for (std::size_t i = 0; i < description.planes.size(); ++i) {
        if (auto plane = check_plane(description.planes[i], i + 1); !plane) return plane;
    }
    for (std::size_t i = 0; i < description.fields.size(); ++i) {
        if (auto field = check_field(description.fields[i], i + 1); !field) return field;
    }
    for (std::size_t i = 0; i < description.bodies.size(); ++i) {
        if (auto body = check_body(description.bodies[i], i + 1); !body) return body;
    }
    return {};
}

std::uint64_t hash(const Description& description)
{
    Hash hash;
    hash.add(std::uint64_t{description.bodies.size()});
    for (const BodyDescription& body : description.bodies) add(hash, body);
    hash.add(std::uint64_t{description.planes.size()});
    for (const PlaneDescription& plane : description.planes) {
        hash.add(plane.normal);
        hash.add(plane.offset_m);
        hash.add(plane.material);
    }
    const HandDescription& hands = description.hands;
    for (const double value : {hands.radius_m, hands.stiffness_n_per_m, hands.damping_ns_per_m,
                               hands.force_max_n, hands.grip_reach_m}) {
        hash.add(value);
    }
    hash.add(std::uint64_t{hands.count});
    hash.add(description.gravity);
    // Scenes without it keep the hash that they have without this member.
    if (hands.friction != 0.0) hash.add(hands.friction);
    constexpr std::uint64_t felt_mark = 0x66656c74;
    for (std::size_t i = 0; i < description.planes.size(); ++i) {
        if (description.planes[i].felt) hash.add(felt_mark + i);
    }
    const auto add_feel = [&hash](const Feel& feel) {
        constexpr double unset = -1.0;
        hash.add(feel.stiffness_n_per_m.value_or(unset));
        hash.add(feel.damping_ns_per_m.value_or(unset));
    };
    for (std::size_t i = 0; i < description.bodies.size(); ++i) {
        if (!description.bodies[i].feel.is_own()) continue;
        hash.add(std::uint64_t{i});
        add_feel(description.bodies[i].feel);
    }
    for (const Feel& feel : description.own_hands) add_feel(feel);
    constexpr std::uint64_t round_mark = 0x726f756e64;
    for (std::size_t i = 0; i < description.bodies.size(); ++i) {
        const Shape shape = description.bodies[i].shape;
        if (shape == Shape::box) continue;
        hash.add(round_mark + (std::uint64_t{i} << 1U) + (shape == Shape::capsule ? 1U : 0U));
    }
    for (const FieldDescription& field : description.fields) {
        for (const glm::dvec3& v :
             {field.position.value, field.force.value, field.half.value_or(glm::dvec3{0.0}),
              field.line.value_or(glm::dvec3{0.0})}) {
            hash.add(v);
        }
        for (const double value :
             {field.damping_ns_per_m, field.stiffness_n_per_m, field.force_limit_n}) {
            hash.add(value);
        }
        hash.add(std::uint64_t{(field.on_hands ? 1U : 0U) | (field.on_bodies ? 2U : 0U)});
    }
    add_hand_friction(hash, description);
    add_parts(hash, description);
    return hash.value();
}

Description paper_scene()
{
    BodyDescription cube{.name = "cube"};
    cube.turning = Turning::locked;
    cube.locked = {.y = true, .z = true};
    cube.drag_ns_per_m = 10.0;
    BodyDescription obstacle{.name = "static cube", .movable = false};
    obstacle.position = {{0.1147, 0.0, 0.030}};
    Description scene{.name = "paper"};
    scene.bodies = {cube, obstacle};
    scene.planes = {{.name = "platform", .offset_m = -0.020}};
    return scene;
}

} // namespace hapnet::scene
