// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/scene/random_play.hpp"

namespace hapnet::test {

namespace {

glm::dvec3 flipped(const glm::dvec3& v) { return {-v.x, v.y, v.z}; }
glm::dquat flipped(const glm::dquat& q) { return {q.w, q.x, -q.y, -q.z}; }
/// Rotation is mirrored with the opposite sign.
glm::dvec3 flipped_turn(const glm::dvec3& v) { return {v.x, -v.y, -v.z}; }

} // namespace

scene::BodyState mirrored(scene::BodyState state)
{
    state.position.value = flipped(state.position.value);
    state.orientation = flipped(state.orientation);
    state.velocity.value = flipped(state.velocity.value);
    state.angular_velocity = flipped_turn(state.angular_velocity);
    return state;
}

RandomPlay mirrored(RandomPlay play)
{
    for (scene::BodyDescription& body : play.description.bodies) {
        body.position.value = flipped(body.position.value);
        body.orientation = flipped(body.orientation);
        body.velocity.value = flipped(body.velocity.value);
        body.angular_velocity = flipped_turn(body.angular_velocity);
        body.sway.by = flipped(body.sway.by);
        for (scene::PartDescription& part : body.parts) {
            part.position.value = flipped(part.position.value);
            part.orientation = flipped(part.orientation);
        }
    }
    for (scene::FieldDescription& field : play.description.fields) {
        field.position.value = flipped(field.position.value);
        field.force.value = flipped(field.force.value);
        if (field.line) field.line = flipped(*field.line);
    }
    for (scene::PlaneDescription& plane : play.description.planes)
        plane.normal = flipped(plane.normal);
    play.description.gravity = flipped(play.description.gravity);
    for (TickInputs& inputs : play.ticks) {
        for (scene::HandInput& hand : inputs.hands) {
            hand.position.value = flipped(hand.position.value);
            hand.velocity.value = flipped(hand.velocity.value);
        }
        for (auto& [body, force] : inputs.pushes) force.value = flipped(force.value);
        for (auto& [body, state] : inputs.places) state = mirrored(state);
        for (Twist& twist : inputs.twists) {
            twist.force = flipped(twist.force);
            twist.at = flipped(twist.at);
            twist.torque = flipped_turn(twist.torque);
        }
        for (Blow& blow : inputs.blows) {
            blow.impulse = flipped(blow.impulse);
            blow.at = flipped(blow.at);
        }
        for (Drive& drive : inputs.drives) {
            drive.velocity = flipped(drive.velocity);
            drive.spin = flipped_turn(drive.spin);
        }
    }
    return play;
}

} // namespace hapnet::test
