// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/falcon.hpp"

#include "device/falcon/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

namespace hapnet::device::falcon {

namespace {

constexpr int last_words = 3; // several, because one packet may be lost
constexpr double velocity_cutoff_hz = 30.0;

Capabilities capabilities_of_falcon()
{
    const base::Position corner{{reach_m, reach_m, reach_m}};
    return {.workspace_min = {-corner.value},
            .workspace_max = corner,
            // The peak force, the stiffness and the damping are from CHAI3D's table of devices.
            .force_max_n = 8.0,
            // An estimate, as nothing is published: the share of the peak that an Omni's motors can
            // hold without a time limit.
            .force_continuous_n = 2.1,
            .stiffness_max_n_per_m = 3000.0,
            .damping_max_ns_per_m = 20.0,
            // Computed: the Jacobian times one count, at the middle of the workspace.
            .resolution_m = 0.00005,
            .speed_max_m_per_s = 1.0,
            .buttons = 4,
            .force_is_calibrated = false,
            .joints =
                JointLimits{.mechanism = mechanism,
                            .torque_max_nm = glm::dvec3{motor_max / counts_per_newton_metre}}};
}

/// Maps the buttons: the centre one, the largest, is the primary one; then plus, forward, minus.
std::uint8_t ours(std::uint8_t theirs)
{
    const auto bit = [&](unsigned from, unsigned to) {
        return static_cast<std::uint8_t>(((theirs >> from) & 1U) << to);
    };
    return static_cast<std::uint8_t>(bit(2, 0) | bit(0, 1) | bit(1, 2) | bit(3, 3));
}

/// Returns the motor counts for a torque. If one exceeds the motor's range, all are scaled down
/// together, so that the direction stays.
Counts counts_for(const glm::dvec3& torque_nm)
{
    // A positive count drives an arm toward smaller angles.
    glm::dvec3 wanted = -counts_per_newton_metre * torque_nm;
    const double most = std::max({std::abs(wanted.x), std::abs(wanted.y), std::abs(wanted.z)});
    if (!std::isfinite(most)) return {};
    if (most > motor_max) wanted *= motor_max / most;
    return {static_cast<std::int16_t>(std::lround(wanted.x)),
            static_cast<std::int16_t>(std::lround(wanted.y)),
            static_cast<std::int16_t>(std::lround(wanted.z))};
}

} // namespace

Identity identity_of(std::string serial)
{
    return {.backend = "falcon",
            .serial = std::move(serial),
            .model = "Novint Falcon",
            .note = std::string{never_run}};
}

Falcon::Falcon(std::unique_ptr<Link> link, std::string serial)
    : link_{std::move(link)},
      identity_{identity_of(std::move(serial))},
      capabilities_{capabilities_of_falcon()},
      velocity_{velocity_cutoff_hz}
{
    sample_.calibrated = false;
}

Falcon::~Falcon()
{
    const Packet rest = encode(Command{});
    for (int i = 0; i < last_words; ++i) link_->send_now(rest);
}

CalibrationStep Falcon::calibrate(base::TimePoint /*now*/)
{
    if (sample_.calibrated) return CalibrationStep::done;
    homes_ = true;
    if (sample_.fault != Fault::none && sample_.fault != Fault::not_calibrated) {
        return CalibrationStep::failed;
    }
    return CalibrationStep::sweep_joints;
}

Sample Falcon::read(base::TimePoint now)
{
    now_ = now;
    if (!last_word_) last_word_ = now;
    ++silent_reads_;
    const bool expects = unanswered_since_ && sample_.fault == Fault::none;
    const auto bytes = link_->receive(expects ? Link::Wait::briefly : Link::Wait::no);
    for (const std::byte byte : bytes) {
        const auto packet = finder_.feed(byte);
        if (!packet) continue;
        if (const auto report = decode_report(*packet)) {
            take(*report, now);
        } else {
            ++nonsense_;
        }
    }
    sample_.fault = fault_at(now);
    return sample_;
}

void Falcon::take(const Report& report, base::TimePoint now)
{
    const bool is_homed = report.legs_homed == all_legs;
    if (is_homed) {
        const Angles angles = angles_of(report.encoders);
        auto place = forward(angles, sample_.hip);
        if (!place) place = forward(angles, {});
        if (!place) {
            ++nonsense_;
            return;
        }
        if (!sample_.calibrated) velocity_ = VelocityFilter{velocity_cutoff_hz};
        sample_.hip = *place;
        sample_.velocity = velocity_.at(*place, now);
        was_calibrated_ = true;
        homes_ = false;
    } else {
        sample_.velocity = {};
    }
    sample_.calibrated = is_homed;
    buttons_.update(ours(report.buttons), now);
    buttons_.tell(sample_);
    ++sample_.sequence;
    last_word_ = now;
    silent_reads_ = 0;
    nonsense_before_ = nonsense_ + finder_.skipped();
    unanswered_since_.reset();
}

Fault Falcon::fault_at(base::TimePoint now) const
{
    if (link_->is_gone()) return Fault::disconnected;
    if (now - *last_word_ > silence_max && silent_reads_ >= silent_reads_min) {
        const bool has_talked = nonsense_ + finder_.skipped() > nonsense_before_;
        return has_talked ? Fault::communication : Fault::timeout;
    }
    return was_calibrated_ && !sample_.calibrated ? Fault::not_calibrated : Fault::none;
}

Command Falcon::resting() const
{
    return {.lights = sample_.calibrated ? Lights::green : Lights::red, .home = homes_};
}

Command Falcon::command_for(const GovernedForce& force) const
{
    Command command = resting();
    if (!force.motors_on() || !sample_.calibrated) return command;
    const glm::dvec3 torque = glm::transpose(jacobian(sample_.hip)) * force.force().value;
    command.motors = counts_for(torque);
    if (command.motors != Counts{}) command.lights = Lights::blue;
    return command;
}

void Falcon::apply(const GovernedForce& force)
{
    const Command command = command_for(force);
    const bool pushes = command.motors != Counts{};
    // Only one unanswered packet is allowed at a time, but the packet that ends a push does not
    // wait for an answer.
    const bool is_late = unanswered_since_ && now_ - *unanswered_since_ >= lost_after;
    const bool ends_push = pushes_ && !pushes;
    if (unanswered_since_ && !is_late && !ends_push) return;
    if (!link_->send(encode(command))) return;
    pushes_ = pushes;
    unanswered_since_ = now_;
}

void Falcon::halt() noexcept
{
    // The last sample belongs to the other thread and is not used here, so the light is switched
    // off, too.
    link_->interrupt(encode(Command{}));
}

} // namespace hapnet::device::falcon
