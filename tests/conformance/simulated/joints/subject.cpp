// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/simulated/joints/joint_omni.hpp"

#include <chrono>

namespace hapnet::conformance {

namespace {

using namespace std::chrono_literals;

const base::Position inkwell = device::omni::position_of(device::omni::inkwell_pose);
constexpr base::Duration for_ever = 10000h;

/// A device that records the torques given to its simulated motors.
class NotedJoints final : public device::Device {
public:
    explicit NotedJoints(std::vector<Command>& commands)
        : omni_{{.plant = {.begins_docked = false}}}, commands_{commands}
    {}
    ~NotedJoints() override
    {
        for (int i = 0; i < 3; ++i) commands_.push_back({}); // it is gone, and its motors with it
    }
    [[nodiscard]] const device::Identity& identity() const override { return omni_.identity(); }
    [[nodiscard]] const device::Capabilities& capabilities() const override
    {
        return omni_.capabilities();
    }
    [[nodiscard]] device::CalibrationStep calibrate(base::TimePoint now) override
    {
        return omni_.calibrate(now);
    }
    [[nodiscard]] device::Sample read(base::TimePoint now) override { return omni_.read(now); }
    void apply(const device::GovernedForce& force) override
    {
        omni_.apply(force);
        commands_.push_back({omni_.plant().torque() == glm::dvec3{0.0}, force.motors_on()});
    }
    void halt() noexcept override
    {
        commands_.push_back({});
        omni_.halt();
    }

    [[nodiscard]] device::JointOmni& omni() { return omni_; }

private:
    device::JointOmni omni_;
    std::vector<Command>& commands_;
};

class JointsSubject final : public Subject {
public:
    [[nodiscard]] Traits traits() const override
    {
        return {.calibrates = true, .docks = true, .exclusive = false};
    }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        auto device = std::make_unique<NotedJoints>(commands_);
        omni_ = &device->omni();
        return device;
    }
    [[nodiscard]] base::TimePoint now() override { return now_; }
    void pass(base::Duration duration) override { now_ += duration; }
    [[nodiscard]] std::vector<Command> commands() const override { return commands_; }

    void help_calibrate() override { omni_->lead_to(inkwell); }
    void dock(bool in) override { omni_->lead_to(in ? inkwell : base::Position{}); }
    void press(bool down) override { omni_->press(down ? 1 : 0); }
    void stall(bool on) override { happen(device::InjectedFault::Kind::stall, on); }
    void garble(bool on) override { happen(device::InjectedFault::Kind::communication_error, on); }
    void unplug() override { happen(device::InjectedFault::Kind::unplug, true); }

private:
    void happen(device::InjectedFault::Kind kind, bool on)
    {
        device::InjectedFaults injected_faults;
        if (on) injected_faults.schedule.push_back({kind, 0ms, for_ever});
        omni_->set_injected_faults(injected_faults);
    }

    base::TimePoint now_{1000s};
    std::vector<Command> commands_;
    device::JointOmni* omni_ = nullptr;
};

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<JointsSubject>(); }

} // namespace hapnet::conformance
