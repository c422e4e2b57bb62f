// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/query.hpp"

#include "scene/collide/box_plane.hpp"
#include "scene/collide/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

namespace hapnet::scene {

namespace {

// Surfaces nearer than this share of the smallest half edge of the two count as touching.
constexpr double touch_share = 2e-6;

OrientedBox box_of(const World& world, BodyId body)
{
    const Bodies& bodies = world.state().bodies;
    return scene::box_of(bodies, bodies.slot_of.at(body));
}

double radius_of(const World& world, BodyId body)
{
    const Bodies& bodies = world.state().bodies;
    const glm::dvec3& half = bodies.properties[bodies.slot_of[body]].half;
    return std::sqrt(glm::dot(half, half));
}

/// Returns one part of a body. Most bodies have one part.
OrientedBox shape_of(const World& world, PartId part)
{
    return scene::shape_of(world.state().bodies, part);
}

/// Returns the least separation of two sets of parts.
template <typename ForParts, typename Separate>
Separation least_separation(ForParts for_parts, Separate separate)
{
    std::optional<Separation> least;
    for_parts([&](PartId part) {
        const Separation its = separate(part);
        if (!least || its.distance < least->distance) least = its;
    });
    return *least;
}

/// True if a body is certainly farther from a point than `within`.
bool is_beyond(const World& world, BodyId body, const glm::dvec3& point, double within)
{
    const glm::dvec3 way = world.position(body).value - point;
    const double reach = within + radius_of(world, body);
    return glm::dot(way, way) > reach * reach;
}

/// A list of contacts in their order, as many as there is room for.
class ContactList {
public:
    explicit ContactList(std::span<Contact> room) : room_{room} {}

    void add(const Contact& contact)
    {
        ++found_;
        std::size_t place = std::min(found_ - 1, room_.size());
        if (place == room_.size() && (place == 0 || !is_before(contact, room_[--place]))) return;
        for (; place > 0 && is_before(contact, room_[place - 1]); --place)
            room_[place] = room_[place - 1];
        room_[place] = contact;
    }
    [[nodiscard]] std::size_t found() const { return found_; }

private:
    static bool is_before(const Contact& a, const Contact& b)
    {
        return std::tuple{a.body, a.other.kind, a.other.index} <
               std::tuple{b.body, b.other.kind, b.other.index};
    }

    std::span<Contact> room_;
    std::size_t found_ = 0;
};

/// Finds out whether two parts touch, and where.
class ContactFinder {
public:
    ContactFinder(const World& world, ContactList& list) : world_{world}, list_{list} {}

    /// Adds the contact of a part of a body (`first`) and a part of another one, if there is one.
    void add_bodies(PartId first, PartId other, double impulse, BoxBoxMemory memory = {})
    {
        const Bodies& bodies = world_.state().bodies;
        const OrientedBox box = shape_of(world_, first);
        const OrientedBox its = shape_of(world_, other);
        const double touch = touch_share * smallest_half(box, its);
        Contact contact{.body = bodies.body_of(first),
                        .other = {Thing::Kind::body, bodies.body_of(other)}};
        contact.normal_impulse = impulse;
        if (set_place(contact, collide(its, box, touch, memory), touch)) {
            list_.add(contact);
        } else if (impulse > 0.0) { // the two have parted since the tick
            const Separation apart = separation(box, its);
            contact.at.value = 0.5 * (apart.on_first + apart.on_second);
            contact.normal = apart.direction;
            contact.separation = apart.distance;
            list_.add(contact);
        }
    }

    void add_plane(PartId part, std::uint32_t plane, double impulse)
    {
        const OrientedBox box = shape_of(world_, part);
        const PlaneDescription& its = world_.frozen().planes[plane];
        const double touch = touch_share * std::min({box.half.x, box.half.y, box.half.z});
        Contact contact{.body = world_.state().bodies.body_of(part),
                        .other = {Thing::Kind::plane, plane}};
        contact.normal_impulse = impulse;
        const PlaneSurface surface{its.normal, its.offset_m};
        if (set_place(contact, collide(surface, box, touch), touch)) {
            list_.add(contact);
        } else if (impulse > 0.0) {
            const double everything = std::numeric_limits<double>::infinity();
            Manifold manifold = collide(surface, box, everything);
            double deepest = everything;
            for (const ContactPoint& point : manifold.touching())
                deepest = std::min(deepest, point.separation);
            set_place(contact, manifold, deepest + touch);
            list_.add(contact);
        }
    }

private:
    /// Sets the contact's place from the points that are at most `touch` apart. Returns false when
    /// there are none.
    static bool set_place(Contact& contact, const Manifold& manifold, double touch)
    {
        glm::dvec3 sum{0.0};
        double touching = 0.0;
        contact.normal = manifold.normal;
        contact.separation = std::numeric_limits<double>::infinity();
        for (const ContactPoint& point : manifold.touching()) {
            if (point.separation > touch) continue;
            sum += point.position;
            touching += 1.0;
            contact.separation = std::min(contact.separation, point.separation);
        }
        if (touching == 0.0) return false;
        contact.at.value = sum / touching;
        return true;
    }

    const World& world_;
    ContactList& list_;
};

/// The contacts of one body, from the data of a stepper.
class StepperContacts {
public:
    StepperContacts(const World& world, ContactFinder& finder) : world_{world}, finder_{finder} {}

    /// Adds contacts with bodies of higher ids, and with planes. If `all`, adds those with bodies
    /// of lower ids, too.
    void add(BodyId body, bool all) const
    {
        std::visit([&](const auto& stepper) { add(stepper, body, all); }, world_.stepper());
    }

private:
    static double impulse_of(const ContactMemory& memory)
    {
        return memory.count > 0 ? memory.normal_impulse_of_tick : 0.0;
    }

    void add(const FreeFlightStepper& /*stepper*/, BodyId /*body*/, bool /*all*/) const {}

    template <BroadPhase broad_phase>
    void add(const RigidStepper<broad_phase>& stepper, BodyId body, bool all) const
    {
        const PairSet& pairs = stepper.pairs().all_pairs();
        const PairSet& planes = stepper.pairs().all_plane_pairs();
        const Bodies& bodies = world_.state().bodies;
        // The further parts' ids are not in the order of their bodies'.
        const auto is_listed = [&](PartId other) { return all || body < bodies.body_of(other); };
        bodies.for_parts(body, [&](PartId part) {
            pairs.for_first(part, [&](PairIndex i) {
                if (is_listed(pairs[i].b))
                    finder_.add_bodies(part, pairs[i].b, impulse_of(pairs[i].memory),
                                       pairs[i].memory.axis);
            });
            pairs.for_second(part, [&](PairIndex i) {
                if (is_listed(pairs[i].a))
                    finder_.add_bodies(part, pairs[i].a, impulse_of(pairs[i].memory));
            });
            planes.for_first(part, [&](PairIndex i) {
                finder_.add_plane(part, planes[i].b, impulse_of(planes[i].memory));
            });
        });
    }

    /// Adds the contacts of the stepper's one box. Everything else is fixed and parallel to the
    /// box.
    template <bool coulomb>
    void add(const OneBoxStepper<coulomb>& stepper, BodyId body, bool all) const
    {
        const Bodies& bodies = world_.state().bodies;
        const BodyId box = bodies.properties[0].id;
        const glm::dvec3 given = stepper.contact_impulse(world_.frozen(), world_.state());
        const auto share = [&](const glm::dvec3& normal) {
            const double impulse = glm::dot(normal, given);
            if (!(impulse > 0.0)) return 0.0;
            double sharing = 0.0;
            for_touching(box, given, [&](Thing, const glm::dvec3& other) {
                if (glm::dot(normal, other) > 0.5) sharing += 1.0;
            });
            return impulse / std::max(sharing, 1.0);
        };
        for_touching(box, given, [&](Thing what, const glm::dvec3& normal) {
            const double impulse = share(normal);
            if (what.kind == Thing::Kind::plane) {
                if (body == box) finder_.add_plane(box, what.index, impulse);
                return;
            }
            const BodyId first = std::min(box, what.index);
            const BodyId second = std::max(box, what.index);
            if (body == first) finder_.add_bodies(first, second, impulse);
            if (body == second && all) finder_.add_bodies(second, first, impulse);
        });
    }

    /// Calls visit(thing, normal) for each thing that the one box touches, or has pushed and just
    /// left. The normal points to the box.
    template <typename Visit>
    void for_touching(BodyId box, const glm::dvec3& given, Visit visit) const
    {
        const Bodies& bodies = world_.state().bodies;
        const OrientedBox its = box_of(world_, box);
        const glm::dvec3 gone = world_.frozen().tick * world_.velocity(box).value;
        const double far = std::sqrt(glm::dot(gone, gone));
        const auto consider = [&](Thing what, const Manifold& manifold, double touch) {
            const bool has_left = glm::dot(given, manifold.normal) > 0.0 &&
                                  lies_on(manifold, touch + glm::dot(gone, manifold.normal));
            if (has_left || lies_on(manifold, touch)) visit(what, manifold.normal);
        };
        for (BodyId id = 0; id < bodies.size(); ++id) {
            if (id == box) continue;
            const OrientedBox other = box_of(world_, id);
            const double touch = touch_share * smallest_half(other, its);
            BoxBoxMemory memory;
            consider({Thing::Kind::body, id}, collide(other, its, touch + far, memory), touch);
        }
        const auto& planes = world_.frozen().planes;
        const double touch = touch_share * std::min({its.half.x, its.half.y, its.half.z});
        for (std::uint32_t i = 0; i < planes.size(); ++i) {
            const PlaneSurface surface{planes[i].normal, planes[i].offset_m};
            consider({Thing::Kind::plane, i}, collide(surface, its, touch + far), touch);
        }
    }

    const World& world_;
    ContactFinder& finder_;
};

/// Returns where a ray enters a half-space.
std::optional<RayEntry> enter(const PlaneDescription& plane, const glm::dvec3& origin,
                              const glm::dvec3& direction, double length)
{
    const double height = glm::dot(plane.normal, origin) - plane.offset_m;
    if (height < 0.0) return RayEntry{0.0, -direction};
    const double sinking = -glm::dot(plane.normal, direction);
    if (!(sinking > 0.0) || height > length * sinking) return std::nullopt;
    return RayEntry{height / sinking, plane.normal};
}

} // namespace

std::size_t contacts(const World& world, std::span<Contact> room)
{
    ContactList list{room};
    ContactFinder finder{world, list};
    const StepperContacts known{world, finder};
    for (BodyId body = 0; body < world.state().bodies.size(); ++body) known.add(body, false);
    return list.found();
}

std::size_t contacts_of(const World& world, BodyId body, std::span<Contact> room)
{
    if (body >= world.state().bodies.size()) return 0;
    ContactList list{room};
    ContactFinder finder{world, list};
    StepperContacts{world, finder}.add(body, true);
    return list.found();
}

std::optional<RayHit> cast_ray(const World& world, const Ray& ray)
{
    const double size = std::sqrt(glm::dot(ray.direction, ray.direction));
    if (!base::is_finite(ray.origin) || !std::isfinite(size) || !(size > 0.0)) return std::nullopt;
    const glm::dvec3& origin = ray.origin.value;
    const glm::dvec3 direction = ray.direction / size;
    std::optional<RayHit> first;
    double length = ray.length_max_m;
    const auto take = [&](Thing what, const std::optional<RayEntry>& entry) {
        if (!entry || (first && entry->distance >= first->distance_m)) return;
        length = entry->distance;
        first = RayHit{what, length, {origin + length * direction}, entry->normal};
    };
    for (BodyId body = 0; body < world.state().bodies.size(); ++body) {
        const glm::dvec3 offset = world.position(body).value - origin;
        const glm::dvec3 aside = offset - glm::dot(offset, direction) * direction;
        const double radius = radius_of(world, body);
        constexpr double rounding = 1e-9;
        if (glm::dot(aside, aside) > (1.0 + rounding) * radius * radius) continue;
        world.state().bodies.for_parts(body, [&](PartId part) {
            take({Thing::Kind::body, body},
                 enter(shape_of(world, part), origin, direction, length));
        });
    }
    const auto& planes = world.frozen().planes;
    for (std::uint32_t i = 0; i < planes.size(); ++i)
        take({Thing::Kind::plane, i}, enter(planes[i], origin, direction, length));
    return first;
}

Separation separation(const World& world, const base::Position& point, BodyId body)
{
    return least_separation(
        [&](const auto& visit) { world.state().bodies.for_parts(body, visit); },
        [&](PartId part) { return separation(point.value, shape_of(world, part)); });
}

Separation separation(const World& world, BodyId first, BodyId second)
{
    const Bodies& bodies = world.state().bodies;
    return least_separation(
        [&](const auto& visit) { bodies.for_parts(first, visit); },
        [&](PartId part) {
            const OrientedBox its = shape_of(world, part);
            return least_separation(
                [&](const auto& visit) { bodies.for_parts(second, visit); },
                [&](PartId other) { return separation(its, shape_of(world, other)); });
        });
}

std::optional<NearestBody> nearest_body(const World& world, const base::Position& point)
{
    std::optional<NearestBody> nearest;
    for (BodyId body = 0; body < world.state().bodies.size(); ++body) {
        const bool is_far = nearest && nearest->separation.distance > 0.0 &&
                            is_beyond(world, body, point.value, nearest->separation.distance);
        if (is_far) continue;
        const Separation its = separation(world, point, body);
        if (!nearest || its.distance < nearest->separation.distance)
            nearest = NearestBody{body, its};
    }
    return nearest;
}

std::size_t bodies_in_sphere(const World& world, const base::Position& centre, double radius_m,
                             std::span<BodyId> room)
{
    std::size_t found = 0;
    for (BodyId body = 0; body < world.state().bodies.size(); ++body) {
        if (is_beyond(world, body, centre.value, radius_m)) continue;
        if (!(separation(world, centre, body).distance <= radius_m)) continue;
        if (found < room.size()) room[found] = body;
        ++found;
    }
    return found;
}

} // namespace hapnet::scene
