// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/simulated/omni.hpp"

#include <chrono>

namespace hapnet::conformance {

namespace {

/// A device that records the commands given to its simulated motors.
class NotedOmni final : public device::Device {
public:
    explicit NotedOmni(std::vector<Command>& commands) : omni_{{}}, commands_{commands} {}
    ~NotedOmni() override
    {
        for (int i = 0; i < 3; ++i) commands_.push_back({}); // it is gone, and its motors with it
    }
    [[nodiscard]] const device::Identity& identity() const override { return omni_.identity(); }
    [[nodiscard]] const device::Capabilities& capabilities() const override
    {
        return omni_.capabilities();
    }
    [[nodiscard]] device::Sample read(base::TimePoint now) override { return omni_.read(now); }
    void apply(const device::GovernedForce& force) override
    {
        commands_.push_back({force.force() == base::Force{}, force.motors_on()});
        omni_.apply(force);
    }
    void halt() noexcept override
    {
        commands_.push_back({});
        omni_.halt();
    }

private:
    device::SimulatedOmni omni_;
    std::vector<Command>& commands_;
};

class SimulatedSubject final : public Subject {
public:
    [[nodiscard]] Traits traits() const override
    {
        return {.stalls = false, .unplugs = false, .garbles = false, .exclusive = false};
    }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        return std::make_unique<NotedOmni>(commands_);
    }
    [[nodiscard]] base::TimePoint now() override { return now_; }
    void pass(base::Duration duration) override { now_ += duration; }
    [[nodiscard]] std::vector<Command> commands() const override { return commands_; }

private:
    base::TimePoint now_{std::chrono::seconds{1000}};
    std::vector<Command> commands_;
};

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<SimulatedSubject>(); }

} // namespace hapnet::conformance
