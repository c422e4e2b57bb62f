// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/omni1394/transport/omni1394s.hpp"
#include "tests/support/omni1394/firewire_omni.hpp"

#include <algorithm>
#include <chrono>

namespace hapnet::conformance {

namespace {

namespace omni1394 = device::omni1394;

const base::Position inkwell = device::omni::position_of(device::omni::inkwell_pose);

/// The backend through the kernel's interface. Its time is virtual, as nothing in the double waits.
class Omni1394Subject final : public Subject {
public:
    [[nodiscard]] Traits traits() const override { return {.calibrates = true, .docks = true}; }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        return omni1394::open_omni("70427300007", {.profile = "", .uncalibrated_force = true});
    }
    [[nodiscard]] base::TimePoint now() override { return now_; }
    void pass(base::Duration duration) override
    {
        now_ += duration;
        omni_.live(static_cast<int>(duration / std::chrono::milliseconds{1}));
    }
    [[nodiscard]] std::vector<Command> commands() const override
    {
        return omni_.with_omni([](const omni1394::FakeOmni& omni) {
            std::vector<Command> commands;
            for (const auto& packet : omni.heard()) {
                // A packet that cannot be decoded does not count as zero.
                const bool zero = packet && packet->motors == glm::ivec3{0};
                commands.push_back({zero, !packet || packet->motors_on});
            }
            return commands;
        });
    }

    void help_calibrate() override { walk(inkwell); }
    void dock(bool in) override { walk(in ? inkwell : base::Position{}); }
    void press(bool down) override
    {
        omni_.with_omni([&](omni1394::FakeOmni& omni) { omni.press(down ? 1 : 0); });
    }
    void stall(bool on) override
    {
        omni_.with_omni([&](omni1394::FakeOmni& omni) { omni.stall(on); });
    }
    void garble(bool on) override
    {
        omni_.with_omni([&](omni1394::FakeOmni& omni) { omni.garble(on); });
    }
    void unplug() override { omni_.unplug(); }
    void plug_in() override { omni_.plug_in(); }

private:
    void walk(const base::Position& place)
    {
        omni_.with_omni([&](omni1394::FakeOmni& omni) { omni.lead_to(place); });
    }

    base::TimePoint now_{std::chrono::seconds{1000}};
    umockdev::Testbed testbed_;
    mutable omni1394::FirewireOmni omni_{testbed_, 1, omni1394::FakeOmni{false}};
};

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<Omni1394Subject>(); }

} // namespace hapnet::conformance
