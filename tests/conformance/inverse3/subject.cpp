// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/inverse3/transport/inverse3s.hpp"
#include "proto/net/clock.hpp"
#include "tests/support/inverse3/fake_service.hpp"

namespace hapnet::conformance {

namespace {

using Fate = test::FakeInverseService::Fate;

/// The backend on the double of the vendor's service, over a WebSocket and in real time.
class Inverse3Subject final : public Subject {
public:
    [[nodiscard]] Traits traits() const override { return {.calibrates = true}; }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        return device::inverse3::open_inverse3("", service_.port());
    }
    [[nodiscard]] base::TimePoint now() override { return net::monotonic_now(); }
    void pass(base::Duration duration) override { net::sleep_until(now() + duration); }
    void help_calibrate() override { service_.set(Fate::calibrated, true); }
    void press(bool down) override { service_.set(Fate::pressed, down); }
    void stall(bool on) override { service_.set(Fate::mute, on); }
    void unplug() override { service_.set(Fate::unplugged, true); }
    void plug_in() override { service_.set(Fate::unplugged, false); }
    void garble(bool on) override { service_.set(Fate::garbled, on); }
    [[nodiscard]] std::vector<Command> commands() const override
    {
        std::vector<Command> all;
        for (const glm::dvec3& force : service_.forces()) {
            // The service can only switch motors off by a force of zero.
            const bool zero = force == glm::dvec3{0.0};
            all.push_back({zero, !zero});
        }
        return all;
    }

private:
    test::FakeInverseService service_;
};

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<Inverse3Subject>(); }

} // namespace hapnet::conformance
