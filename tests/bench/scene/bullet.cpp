// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Bullet, in the precision that this file is compiled for: a module, because both precisions use
// the same names.
#include "tests/bench/scene/peers.hpp"
#include "tests/bench/scene/penalty.hpp"

#include <array>
#include <btBulletDynamicsCommon.h>

namespace hapnet::bench {

namespace {

/// Half the edge of the box that stands for a plane. It lies under every body, also under one that
/// flies for a second.
double slab_half(const scene::Description& scene)
{
    double reach = 0.0, way = 2.0;
    for (const auto& body : scene.bodies) {
        const glm::dvec3 distance = glm::abs(body.position.value);
        const glm::dvec3 speed = glm::abs(body.velocity.value);
        reach = std::max({reach, distance.x, distance.y, distance.z});
        way = std::max({way, speed.x, speed.y, speed.z});
    }
    return reach + way;
}

btScalar scalar_of(double x) { return static_cast<btScalar>(x); }

btVector3 bullet_of(const glm::dvec3& v)
{
    return {scalar_of(v.x), scalar_of(v.y), scalar_of(v.z)};
}

btQuaternion bullet_of(const glm::dquat& q)
{
    return {scalar_of(q.x), scalar_of(q.y), scalar_of(q.z), scalar_of(q.w)};
}

glm::dvec3 vector_of(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btScalar friction_of(const btCollisionObject* a, const btCollisionObject* b)
{
    return btSqrt(a->getFriction() * b->getFriction());
}

btScalar restitution_of(const btCollisionObject* a, const btCollisionObject* b)
{
    return btMax(a->getRestitution(), b->getRestitution());
}

/// Only the hand's damping counts between a hand and a body. Bullet would add 0.1 for the body.
btScalar damping_of(const btCollisionObject* a, const btCollisionObject* b)
{
    return a->isKinematicObject() ? a->getContactDamping() : b->getContactDamping();
}

class Bullet final : public Engine {
public:
    Bullet(const Translation& all, const EngineOptions& options)
        : scene_{all.scene},
          options_{options},
          hands_{all},
          dispatcher_{&configuration_},
          world_{&dispatcher_, &broadphase_, &solver_, &configuration_}
    {
        gCalculateCombinedFrictionCallback = friction_of;
        gCalculateCombinedRestitutionCallback = restitution_of;
        gCalculateCombinedContactDampingCallback = damping_of;
        world_.setGravity(bullet_of(scene_.gravity));
        if (!options.is_stock) tune();
        for (std::size_t i = 0; i < all.solids.size(); ++i) add(scene_.bodies[i], all.solids[i]);
        for (const auto& plane : scene_.planes) add(plane);
        if (options.hip_force == HipForce::native) {
            for (std::uint32_t i = 0; i < scene_.hands.count; ++i) add_hip();
        }
    }

    ~Bullet() override
    {
        for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    }

    void set_hand(std::uint32_t index, const scene::HandInput& input) override
    {
        const bool is_new = !hands_.hips()[index].present;
        hands_.set(index, input);
        if (options_.hip_force != HipForce::native) return;
        btRigidBody& hand = *bodies_[first_hip() + index];
        hand.getWorldTransform().setOrigin(bullet_of(input.position.value));
        if (is_new) hand.setInterpolationWorldTransform(hand.getWorldTransform());
        bodies_[0]->activate();
    }

    void step() override
    {
        if (options_.hip_force == HipForce::held) {
            for (std::uint32_t i = 0; i < scene_.hands.count; ++i) push(i);
        }
        for (const std::size_t i : dragged_) {
            const btVector3 v = bodies_[i]->getLinearVelocity();
            const btScalar drag = scalar_of(scene_.bodies[i].drag_ns_per_m);
            bodies_[i]->applyCentralForce({-drag * v.x(), 0, -drag * v.z()});
        }
        if (!scene_.fields.empty()) apply_fields();
        if (!driven_.empty()) drive();
        world_.stepSimulation(scalar_of(options_.tick_s), 0);
    }

    [[nodiscard]] scene::BodyState state(scene::BodyId body) const override
    {
        const btTransform& place = bodies_[body]->getWorldTransform();
        const btQuaternion q = place.getRotation();
        scene::BodyState state;
        state.position.value = vector_of(place.getOrigin());
        state.orientation = {q.w(), q.x(), q.y(), q.z()};
        state.velocity.value = vector_of(bodies_[body]->getLinearVelocity());
        state.angular_velocity = vector_of(bodies_[body]->getAngularVelocity());
        return state;
    }

    [[nodiscard]] glm::dvec3 hip_force(std::uint32_t index) const override
    {
        return options_.hip_force == HipForce::held ? forces_[index] : contact_force(index);
    }

private:
    void tune()
    {
        gDbvtMargin = scalar_of(0.002);
        gDeactivationTime = scalar_of(0.3);
        world_.getSolverInfo().m_restitutionVelocityThreshold = scalar_of(1e-3);
        world_.setForceUpdateAllAabbs(false);
        // A body that moves less than this in a tick is not swept. The default is 40 mm.
        world_.getDispatchInfo().m_allowedCcdPenetration = 0;
    }

    btRigidBody& add(std::unique_ptr<btCollisionShape> shape, double mass, const btTransform& place)
    {
        btVector3 inertia{0, 0, 0};
        if (mass > 0.0) shape->calculateLocalInertia(scalar_of(mass), inertia);
        btRigidBody::btRigidBodyConstructionInfo info{scalar_of(mass), nullptr, shape.get(),
                                                      inertia};
        info.m_startWorldTransform = place;
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        shapes_.push_back(std::move(shape));
        return *bodies_.back();
    }

    static void give_skin(btRigidBody& body, const scene::Material& material)
    {
        body.setFriction(scalar_of(material.friction));
        body.setRestitution(scalar_of(material.restitution));
    }

    static std::unique_ptr<btCollisionShape> shape_of(const scene::BodyPart& part)
    {
        if (part.rounding == 0.0) return std::make_unique<btBoxShape>(bullet_of(part.half));
        const btScalar radius = scalar_of(part.rounding);
        const Core core = core_of(part);
        if (core.half == 0.0) return std::make_unique<btSphereShape>(radius);
        const btScalar length = scalar_of(2.0 * core.half);
        if (core.axis == 0) return std::make_unique<btCapsuleShapeX>(radius, length);
        if (core.axis == 1) return std::make_unique<btCapsuleShape>(radius, length);
        return std::make_unique<btCapsuleShapeZ>(radius, length);
    }

    std::unique_ptr<btCollisionShape> shape_of(const Solid& solid)
    {
        if (solid.parts.size() == 1) return shape_of(solid.parts[0]);
        auto whole = std::make_unique<btCompoundShape>();
        for (const scene::BodyPart& part : solid.parts) {
            shapes_.push_back(shape_of(part));
            const btTransform place{bullet_of(glm::quat_cast(part.axes)), bullet_of(part.at)};
            whole->addChildShape(place, shapes_.back().get());
        }
        return whole;
    }

    void add(const scene::BodyDescription& one, const Solid& solid)
    {
        const btTransform place{bullet_of(solid.frame.orientation),
                                bullet_of(solid.frame.centre.value)};
        btRigidBody& body = add(shape_of(solid), one.movable ? one.mass_kg : 0.0, place);
        // For a capsule Bullet takes the box around it.
        if (one.movable && !solid.is_box()) {
            body.setMassProps(scalar_of(one.mass_kg), bullet_of(solid.moments));
            body.updateInertiaTensor();
        }
        if (one.kinematic) {
            body.setCollisionFlags(body.getCollisionFlags() |
                                   btCollisionObject::CF_KINEMATIC_OBJECT);
            body.forceActivationState(DISABLE_DEACTIVATION);
            driven_.push_back(bodies_.size() - 1);
        }
        give_skin(body, one.material);
        if (one.movable) {
            body.setLinearVelocity(bullet_of(one.velocity.value));
            body.setAngularVelocity(bullet_of(one.angular_velocity));
            body.setLinearFactor({one.locked.x ? scalar_of(0) : scalar_of(1),
                                  one.locked.y ? scalar_of(0) : scalar_of(1),
                                  one.locked.z ? scalar_of(0) : scalar_of(1)});
            if (one.turning == scene::Turning::locked) body.setAngularFactor(scalar_of(0));
            if (one.drag_ns_per_m > 0.0) dragged_.push_back(bodies_.size() - 1);
            if (!options_.is_stock) body.setSleepingThresholds(scalar_of(0.01), scalar_of(0.5));
            if (options_.has_fast_bodies) guard(body, one.half);
        }
        world_.addRigidBody(&body);
        if (!options_.sleeping) body.forceActivationState(DISABLE_DEACTIVATION);
        if (options_.begins_asleep && one.movable && bodies_.size() > 1) {
            body.forceActivationState(ISLAND_SLEEPING);
        }
    }

    static void guard(btRigidBody& body, const glm::dvec3& half)
    {
        const btScalar least = scalar_of(std::min({half.x, half.y, half.z}));
        body.setCcdMotionThreshold(least / 2);
        body.setCcdSweptSphereRadius(least / 2);
    }

    /// Adds a box for a plane, unless the scene asks for Bullet's own plane. The box makes better
    /// contacts.
    void add(const scene::PlaneDescription& plane)
    {
        const glm::dvec3 n = plane.normal;
        if (options_.has_own_planes) {
            btRigidBody& own =
                add(std::make_unique<btStaticPlaneShape>(bullet_of(n), scalar_of(plane.offset_m)),
                    0.0, btTransform::getIdentity());
            give_skin(own, plane.material);
            world_.addRigidBody(&own);
            return;
        }
        const double half = slab_half(scene_);
        const btVector3 up{0, 1, 0}, normal = bullet_of(n);
        const btQuaternion turn = shortestArcQuat(up, normal);
        btRigidBody& body = add(std::make_unique<btBoxShape>(bullet_of(glm::dvec3{half})), 0.0,
                                btTransform{turn, bullet_of((plane.offset_m - half) * n)});
        give_skin(body, plane.material);
        world_.addRigidBody(&body);
    }

    void apply_fields()
    {
        for (scene::BodyId i = 0; i < scene_.bodies.size(); ++i) {
            if (!scene_.bodies[i].movable) continue;
            bodies_[i]->applyCentralForce(bullet_of(force_of_fields(scene_, state(i))));
        }
    }

    /// Moves kinematic bodies. Bullet computes their velocity from their previous place.
    void drive()
    {
        ++steps_;
        for (const std::size_t i : driven_) {
            const double time_s = options_.tick_s * steps_;
            const glm::dvec3 way = time_s * scene_.bodies[i].velocity.value;
            bodies_[i]->getWorldTransform().setOrigin(
                bullet_of(scene_.bodies[i].position.value + way));
        }
    }

    void add_hip()
    {
        const btScalar far = scalar_of(1.0 + static_cast<double>(bodies_.size()));
        btRigidBody& hand =
            add(std::make_unique<btSphereShape>(scalar_of(scene_.hands.radius_m)), 0.0,
                btTransform{btQuaternion::getIdentity(), btVector3{0, far, 0}});
        hand.setFriction(0);
        hand.setCollisionFlags(hand.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
        hand.setContactStiffnessAndDamping(scalar_of(scene_.hands.stiffness_n_per_m),
                                           scalar_of(scene_.hands.damping_ns_per_m));
        hand.forceActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(&hand);
    }

    [[nodiscard]] std::size_t first_hip() const
    {
        return scene_.bodies.size() + scene_.planes.size();
    }

    void push(std::uint32_t index)
    {
        const Load load = hands_.on_body(index, state(0));
        forces_[index] = load.force + hands_.on_planes(index);
        if (load.force == glm::dvec3{0.0}) return;
        bodies_[0]->activate();
        bodies_[0]->applyForce(bullet_of(load.force),
                               bullet_of(load.point) - bodies_[0]->getWorldTransform().getOrigin());
    }

    [[nodiscard]] glm::dvec3 contact_force(std::uint32_t index) const
    {
        glm::dvec3 force{0.0};
        const btCollisionObject* hand = bodies_[first_hip() + index].get();
        const btDispatcher& dispatcher = dispatcher_;
        for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
            const btPersistentManifold& manifold =
                *const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
            const bool is_first = manifold.getBody0() == hand;
            if (!is_first && manifold.getBody1() != hand) continue;
            for (int j = 0; j < manifold.getNumContacts(); ++j) {
                const btManifoldPoint& point = manifold.getContactPoint(j);
                const double impulse = point.getAppliedImpulse() * (is_first ? -1.0 : 1.0);
                force += impulse / options_.tick_s * vector_of(point.m_normalWorldOnB);
            }
        }
        return force;
    }

    scene::Description scene_;
    EngineOptions options_;
    HeldHands hands_;
    std::vector<std::unique_ptr<btCollisionShape>> shapes_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_; // bodies, planes, hands
    std::vector<std::size_t> dragged_;
    std::vector<std::size_t> driven_; // kinematic
    int steps_ = 0;                   // that these have been driven
    std::array<glm::dvec3, scene::hands_max> forces_{};
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
};

} // namespace

} // namespace hapnet::bench

extern "C" hapnet::bench::Engine*
hapnet_bench_make_engine(const hapnet::bench::Translation* all,
                         const hapnet::bench::EngineOptions* options)
{
    return new hapnet::bench::Bullet{*all, *options};
}
