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
constexpr double locked_inertia = 1e6; // times its own: ODE has no other way to lock a body

long complaints = 0; // of ODE about itself: its direct solver's "LCP internal error"

void count_complaint(int, const char*, va_list) { ++complaints; }

bool initialise()
{
    dSetMessageHandler(count_complaint);
    return dInitODE2(0) != 0;
}

enum class Stepping : std::uint8_t { quick, direct };

std::array<double, 3> array_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

glm::dvec3 vector_of(const dReal* v) { return {v[0], v[1], v[2]}; }

/// What a geometry needs to be known of when it touches something.
struct Skin {
    scene::Material material;
    bool is_hip = false;
};

class Ode final : public Engine {
public:
    Ode(const scene::Description& scene, const EngineOptions& options, Stepping stepping)
        : scene_{scene}, options_{options}, stepping_{stepping}
    {
        static const bool is_ready = initialise();
        std::ignore = is_ready;
        world_ = dWorldCreate();
        dRandSetSeed(0); // QuickStep shuffles its constraints: so that a scene repeats
        space_ = space_for(scene, options);
        contacts_ = dJointGroupCreate(0);
        dWorldSetGravity(world_, scene.gravity.x, scene.gravity.y, scene.gravity.z);
        if (options.sleeping) set_sleeping();
        skins_.reserve(scene.bodies.size() + scene.planes.size() + scene.hands.count);
        for (const auto& plane : scene.planes) add(plane);
        for (const auto& body : scene.bodies) add(body);
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
        hips_[index] = input;
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
    /// The cheapest for that number of geometries: all pairs, or sweep and prune, up last. Measured
    /// in November 2026: from 24 geometries on the sweep is cheaper, and with 1000 it takes 0.2 to
    /// 0.5 of what the hash space takes, which most programs choose.
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

    void add(const scene::BodyDescription& body)
    {
        const glm::dvec3 edges = 2.0 * body.half;
        const dGeomID geom = dCreateBox(space_, edges.x, edges.y, edges.z);
        give_skin(geom, body.material, false);
        const auto& p = body.position.value;
        const dQuaternion q{body.orientation.w, body.orientation.x, body.orientation.y,
                            body.orientation.z};
        if (!body.movable) {
            dGeomSetPosition(geom, p.x, p.y, p.z);
            dGeomSetQuaternion(geom, q);
            bodies_.push_back(nullptr);
            return;
        }
        const dBodyID id = dBodyCreate(world_);
        dMass mass;
        dMassSetBoxTotal(&mass, body.mass_kg, edges.x, edges.y, edges.z);
        if (body.turning == scene::Turning::locked) {
            for (dReal& moment : mass.I) moment *= locked_inertia;
        }
        dBodySetMass(id, &mass);
        dGeomSetBody(geom, id);
        dBodySetPosition(id, p.x, p.y, p.z);
        dBodySetQuaternion(id, q);
        const auto v = array_of(body.velocity.value), w = array_of(body.angular_velocity);
        dBodySetLinearVel(id, v[0], v[1], v[2]);
        dBodySetAngularVel(id, w[0], w[1], w[2]);
        if (options_.begins_asleep && !bodies_.empty()) dBodyDisable(id);
        bodies_.push_back(id);
        const bool is_held = body.turning == scene::Turning::locked || body.locked.x ||
                             body.locked.y || body.locked.z || body.drag_ns_per_m > 0.0;
        if (is_held) held_.push_back(bodies_.size() - 1);
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
        const Load load = penalty(state(0), scene_.bodies[0].half, hips_[index], scene_.hands);
        if (load.force == glm::dvec3{0.0}) return;
        const auto& f = load.force;
        const auto& p = load.point;
        dBodyEnable(bodies_[0]);
        dBodyAddForceAtPos(bodies_[0], f.x, f.y, f.z, p.x, p.y, p.z);
        forces_[index] = f;
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
            glm::dot(vector_of(contact.normal), hips_[index_of(hip)].velocity.value);
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
    dWorldID world_ = nullptr;
    dSpaceID space_ = nullptr;
    dJointGroupID contacts_ = nullptr;
    std::vector<Skin> skins_;
    std::vector<dBodyID> bodies_;
    std::vector<std::size_t> held_; // bodies with locks or drag
    std::vector<dGeomID> hip_geoms_;
    Hips hips_ = absent_hips();
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
    return std::make_unique<Ode>(scene, options, Stepping::quick);
}

std::unique_ptr<Engine> make_ode_step(const scene::Description& scene, const EngineOptions& options)
{
    return std::make_unique<Ode>(scene, options, Stepping::direct);
}

} // namespace hapnet::bench
