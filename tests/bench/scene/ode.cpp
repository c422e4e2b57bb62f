// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// ODE, which Debian builds in double precision.
#include "tests/bench/scene/peers.hpp"
#include "tests/bench/scene/penalty.hpp"

#include <ode/ode.h>
#include <tuple>

namespace hapnet::bench {

namespace {

constexpr int contacts_max = 4;
constexpr double locked_inertia = 1e6; // times the body's own: ODE has no other way to lock a body

long complaints = 0; // internal errors that ODE reported: "LCP internal error" of its direct solver

void count_complaint(int, const char*, va_list) { ++complaints; }

bool initialise()
{
    dSetMessageHandler(count_complaint);
    return dInitODE2(0) != 0;
}

enum class Stepping : std::uint8_t { quick, direct };

std::array<double, 3> array_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

glm::dvec3 vector_of(const dReal* v) { return {v[0], v[1], v[2]}; }

/// Data of a geometry that its contacts need.
struct Skin {
    scene::Material material;
    bool is_hip = false;
};

class Ode final : public Engine {
public:
    Ode(const Translation& all, const EngineOptions& options, Stepping stepping)
        : scene_{all.scene}, options_{options}, stepping_{stepping}, hands_{all}
    {
        const scene::Description& scene = scene_;
        static const bool is_ready = initialise();
        std::ignore = is_ready;
        world_ = dWorldCreate();
        dRandSetSeed(0); // QuickStep shuffles its constraints: so that a scene repeats
        space_ = space_for(scene, options);
        contacts_ = dJointGroupCreate(0);
        dWorldSetGravity(world_, scene.gravity.x, scene.gravity.y, scene.gravity.z);
        if (options.sleeping) set_sleeping();
        skins_.reserve(geometries_of(all) + scene.planes.size() + scene.hands.count);
        for (const auto& plane : scene.planes) add(plane);
        for (std::size_t i = 0; i < all.solids.size(); ++i) add(scene.bodies[i], all.solids[i]);
        if (options.hip_force == HipForce::native) {
            for (std::uint32_t i = 0; i < scene.hands.count; ++i) add_hip();
        }
    }

    ~Ode() override
    {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }

    void set_hand(std::uint32_t index, const scene::HandInput& input) override
    {
        hands_.set(index, input);
        if (options_.hip_force == HipForce::native) {
            const auto& p = input.position.value;
            dGeomSetPosition(hip_geoms_[index], p.x, p.y, p.z);
            dBodyEnable(bodies_[0]);
        }
    }

    void step() override
    {
        for (std::uint32_t i = 0; i < scene_.hands.count; ++i) push(i);
        resist();
        if (!scene_.fields.empty()) apply_fields();
        dSpaceCollide(space_, this, &Ode::near);
        if (stepping_ == Stepping::quick) {
            dWorldQuickStep(world_, options_.tick_s);
        } else {
            dWorldStep(world_, options_.tick_s);
        }
        gather();
        dJointGroupEmpty(contacts_);
        keep_locks();
    }

    [[nodiscard]] scene::BodyState state(scene::BodyId body) const override
    {
        scene::BodyState state;
        const dBodyID id = bodies_[body];
        if (id == nullptr) {
            state.position = scene_.bodies[body].position;
            state.orientation = scene_.bodies[body].orientation;
            return state;
        }
        const dReal* q = dBodyGetQuaternion(id);
        state.position.value = vector_of(dBodyGetPosition(id));
        state.orientation = glm::dquat{q[0], q[1], q[2], q[3]};
        state.velocity.value = vector_of(dBodyGetLinearVel(id));
        state.angular_velocity = vector_of(dBodyGetAngularVel(id));
        return state;
    }

    [[nodiscard]] glm::dvec3 hip_force(std::uint32_t index) const override
    {
        return forces_[index];
    }

private:
    /// The cheapest space for this number of geometries: all pairs, or sweep and prune, the
    /// vertical axis last. From 24 geometries on the sweep is cheaper. With 1000 it takes 0.2 to
    /// 0.5 of the time of the hash space, which most programs choose.
    static dSpaceID space_for(const scene::Description& scene, const EngineOptions& options)
    {
        constexpr std::size_t few = 24;
        if (options.is_stock) return dHashSpaceCreate(nullptr);
        if (scene.bodies.size() + scene.planes.size() < few) return dSimpleSpaceCreate(nullptr);
        return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY);
    }

    void set_sleeping()
    {
        dWorldSetAutoDisableFlag(world_, 1);
        if (options_.is_stock) return;
        dWorldSetAutoDisableLinearThreshold(world_, 0.01);
        dWorldSetAutoDisableAngularThreshold(world_, 0.5);
        dWorldSetAutoDisableSteps(world_, 0);
        dWorldSetAutoDisableTime(world_, 0.3);
    }

    void give_skin(dGeomID geom, const scene::Material& material, bool is_hip)
    {
        skins_.push_back({material, is_hip});
        dGeomSetData(geom, &skins_.back());
    }

    void add(const scene::PlaneDescription& plane)
    {
        const auto& n = plane.normal;
        give_skin(dCreatePlane(space_, n.x, n.y, n.z, plane.offset_m), plane.material, false);
    }

    static std::size_t geometries_of(const Translation& all)
    {
        std::size_t count = 0;
        for (const Solid& solid : all.solids) count += solid.parts.size();
        return count;
    }

    /// A capsule lies along z in ODE.
    static glm::dquat onto_z(const scene::BodyPart& part)
    {
        const double root = std::sqrt(0.5);
        if (part.rounding == 0.0) return {1.0, 0.0, 0.0, 0.0};
        const int axis = core_of(part).axis;
        if (axis == 2) return {1.0, 0.0, 0.0, 0.0};
        return axis == 0 ? glm::dquat{root, 0.0, root, 0.0} : glm::dquat{root, -root, 0.0, 0.0};
    }

    dGeomID geometry(const scene::BodyPart& part)
    {
        if (part.rounding == 0.0) {
            const glm::dvec3 edges = 2.0 * part.half;
            return dCreateBox(space_, edges.x, edges.y, edges.z);
        }
        const Core core = core_of(part);
        return core.half == 0.0 ? dCreateSphere(space_, part.rounding)
                                : dCreateCapsule(space_, part.rounding, 2.0 * core.half);
    }

    static std::array<double, 4> array_of(const glm::dquat& q) { return {q.w, q.x, q.y, q.z}; }

    void add(const scene::BodyDescription& body, const Solid& solid)
    {
        const auto& p = solid.frame.centre.value;
        const auto q = array_of(solid.frame.orientation);
        if (!body.movable && !body.kinematic) {
            const dGeomID geom = geometry(solid.parts[0]);
            give_skin(geom, body.material, false);
            dGeomSetPosition(geom, p.x, p.y, p.z);
            dGeomSetQuaternion(geom, q.data());
            bodies_.push_back(nullptr);
            return;
        }
        const dBodyID id = dBodyCreate(world_);
        if (body.movable) {
            dMass mass;
            const double share = body.turning == scene::Turning::locked ? locked_inertia : 1.0;
            const glm::dvec3 moments = share * solid.moments;
            dMassSetParameters(&mass, body.mass_kg, 0, 0, 0, moments.x, moments.y, moments.z, 0, 0,
                               0);
            dBodySetMass(id, &mass);
        } else {
            dBodySetKinematic(id);
        }
        for (const scene::BodyPart& part : solid.parts) attach(part, id, body.material);
        dBodySetPosition(id, p.x, p.y, p.z);
        dBodySetQuaternion(id, q.data());
        const auto v = bench::array_of(body.velocity.value);
        const auto w = bench::array_of(body.angular_velocity);
        dBodySetLinearVel(id, v[0], v[1], v[2]);
        dBodySetAngularVel(id, w[0], w[1], w[2]);
        if (options_.begins_asleep && !bodies_.empty()) dBodyDisable(id);
        bodies_.push_back(id);
        const bool is_held = body.turning == scene::Turning::locked || body.locked.x ||
                             body.locked.y || body.locked.z || body.drag_ns_per_m > 0.0;
        if (is_held) held_.push_back(bodies_.size() - 1);
    }

    void attach(const scene::BodyPart& part, dBodyID id, const scene::Material& material)
    {
        const dGeomID geom = geometry(part);
        give_skin(geom, material, false);
        dGeomSetBody(geom, id);
        const glm::dquat turn = glm::quat_cast(part.axes) * onto_z(part);
        if (part.at == glm::dvec3{0.0} && turn == glm::dquat{1.0, 0.0, 0.0, 0.0}) return;
        dGeomSetOffsetPosition(geom, part.at.x, part.at.y, part.at.z);
        dGeomSetOffsetQuaternion(geom, array_of(turn).data());
    }

    void apply_fields()
    {
        for (scene::BodyId i = 0; i < scene_.bodies.size(); ++i) {
            if (!scene_.bodies[i].movable) continue;
            const glm::dvec3 f = force_of_fields(scene_, state(i));
            dBodyAddForce(bodies_[i], f.x, f.y, f.z);
        }
    }

    void add_hip()
    {
        hip_geoms_.push_back(dCreateSphere(space_, scene_.hands.radius_m));
        give_skin(hip_geoms_.back(), {}, true);
    }

    void push(std::uint32_t index)
    {
        forces_[index] = {};
        if (options_.hip_force == HipForce::native) return;
        forces_[index] = hands_.on_planes(index);
        const Load load = hands_.on_body(index, state(0));
        if (load.force == glm::dvec3{0.0}) return;
        const auto& f = load.force;
        const auto& p = load.point;
        dBodyEnable(bodies_[0]);
        dBodyAddForceAtPos(bodies_[0], f.x, f.y, f.z, p.x, p.y, p.z);
        forces_[index] += f;
    }

    /// Viscous friction in the plane that carries it, which is level in every scene here.
    void resist()
    {
        for (const std::size_t i : held_) {
            const double drag = scene_.bodies[i].drag_ns_per_m;
            const dReal* v = dBodyGetLinearVel(bodies_[i]);
            if (drag > 0.0) dBodyAddForce(bodies_[i], -drag * v[0], 0.0, -drag * v[2]);
        }
    }

    void keep_locks()
    {
        for (const std::size_t i : held_) {
            const auto& body = scene_.bodies[i];
            const dReal* v = dBodyGetLinearVel(bodies_[i]);
            const auto start = body.position.value;
            const dReal* p = dBodyGetPosition(bodies_[i]);
            if (body.locked.x || body.locked.y || body.locked.z) {
                dBodySetLinearVel(bodies_[i], body.locked.x ? 0.0 : v[0],
                                  body.locked.y ? 0.0 : v[1], body.locked.z ? 0.0 : v[2]);
                dBodySetPosition(bodies_[i], body.locked.x ? start.x : p[0],
                                 body.locked.y ? start.y : p[1], body.locked.z ? start.z : p[2]);
            }
            if (body.turning == scene::Turning::locked) dBodySetAngularVel(bodies_[i], 0, 0, 0);
        }
    }

    static void near(void* self, dGeomID a, dGeomID b) { static_cast<Ode*>(self)->touch(a, b); }

    void touch(dGeomID a, dGeomID b)
    {
        const dBodyID body_a = dGeomGetBody(a), body_b = dGeomGetBody(b);
        const bool is_awake = (body_a != nullptr && dBodyIsEnabled(body_a) != 0) ||
                              (body_b != nullptr && dBodyIsEnabled(body_b) != 0);
        if (!is_awake) return;
        std::array<dContact, contacts_max> contacts;
        const int count = dCollide(a, b, contacts_max, &contacts[0].geom, sizeof(dContact));
        if (count == 0) return;
        const Skin& skin_a = *static_cast<const Skin*>(dGeomGetData(a));
        const Skin& skin_b = *static_cast<const Skin*>(dGeomGetData(b));
        const bool is_hip = skin_a.is_hip || skin_b.is_hip;
        for (int i = 0; i < count; ++i) {
            dContact& contact = contacts[static_cast<std::size_t>(i)];
            contact.surface = is_hip ? hip_surface(contact.geom, skin_a.is_hip ? a : b)
                                     : surface(skin_a.material, skin_b.material);
            const dJointID joint = dJointCreateContact(world_, contacts_, &contact);
            dJointAttach(joint, body_a, body_b);
            if (is_hip) watch(joint, skin_a.is_hip ? a : b);
        }
    }

    static dSurfaceParameters surface(const scene::Material& a, const scene::Material& b)
    {
        dSurfaceParameters surface{};
        surface.mode = dContactApprox1;
        surface.mu = std::sqrt(a.friction * b.friction);
        surface.bounce = std::max(a.restitution, b.restitution);
        if (surface.bounce > 0.0) {
            surface.mode |= dContactBounce;
            surface.bounce_vel = 1e-3;
        }
        return surface;
    }

    /// The spring and damper as error reduction and constraint force mixing (ODE's manual, 3.8.2).
    [[nodiscard]] dSurfaceParameters hip_surface(const dContactGeom& contact, dGeomID hip) const
    {
        const double h = options_.tick_s, k = scene_.hands.stiffness_n_per_m;
        dSurfaceParameters surface{};
        surface.mode = dContactApprox1 | dContactSoftERP | dContactSoftCFM | dContactMotionN;
        surface.soft_cfm = 1.0 / (h * k + scene_.hands.damping_ns_per_m);
        surface.soft_erp = h * k * surface.soft_cfm;
        const double along =
            glm::dot(vector_of(contact.normal), hands_.hips()[index_of(hip)].velocity.value);
        surface.motionN = hip == contact.g1 ? -along : along;
        return surface;
    }

    [[nodiscard]] std::size_t index_of(dGeomID hip) const
    {
        return static_cast<std::size_t>(std::find(hip_geoms_.begin(), hip_geoms_.end(), hip) -
                                        hip_geoms_.begin());
    }

    void watch(dJointID joint, dGeomID hip)
    {
        if (watched_ == feedback_.size()) return;
        watched_hips_[watched_] = index_of(hip);
        dJointSetFeedback(joint, &feedback_[watched_++]);
    }

    void gather()
    {
        for (std::size_t i = 0; i < watched_; ++i) {
            const glm::dvec3 on_first = vector_of(feedback_[i].f1);
            const glm::dvec3 on_second = vector_of(feedback_[i].f2);
            forces_[watched_hips_[i]] += on_first == glm::dvec3{0.0} ? on_second : on_first;
        }
        watched_ = 0;
    }

    scene::Description scene_;
    EngineOptions options_;
    Stepping stepping_;
    HeldHands hands_;
    dWorldID world_ = nullptr;
    dSpaceID space_ = nullptr;
    dJointGroupID contacts_ = nullptr;
    std::vector<Skin> skins_;
    std::vector<dBodyID> bodies_;
    std::vector<std::size_t> held_; // bodies with locks or drag
    std::vector<dGeomID> hip_geoms_;
    std::array<glm::dvec3, scene::hands_max> forces_{};
    std::array<dJointFeedback, 16> feedback_{};
    std::array<std::size_t, 16> watched_hips_{};
    std::size_t watched_ = 0;
};

} // namespace

long ode_complaints() { return complaints; }

std::unique_ptr<Engine> make_ode_quick(const scene::Description& scene,
                                       const EngineOptions& options)
{
    return std::make_unique<Ode>(translate(scene), options, Stepping::quick);
}

std::unique_ptr<Engine> make_ode_step(const scene::Description& scene, const EngineOptions& options)
{
    return std::make_unique<Ode>(translate(scene), options, Stepping::direct);
}

} // namespace hapnet::bench
