// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/hdapi/transport/hdapis.hpp"
#include "proto/net/clock.hpp"
#include "tests/conformance/hdapi/fake.hpp"

namespace hapnet::conformance {

namespace {

/// The backend on the fake libHD, through dlopen and in real time: the fake has a thread of its
/// own.
class HdapiSubject final : public Subject {
public:
    [[nodiscard]] Traits traits() const override { return {.calibrates = true, .docks = true}; }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        return device::hdapi::open_hdapi("", HAPNET_FAKE_HD);
    }
    [[nodiscard]] base::TimePoint now() override { return net::monotonic_now(); }
    void pass(base::Duration duration) override { net::sleep_until(now() + duration); }
    void help_calibrate() override { dock(true); }
    void dock(bool in) override { fake_.set(0, FakeHdFate::docked, in); }
    void press(bool down) override { fake_.set(0, FakeHdFate::pressed, down); }
    void stall(bool on) override { fake_.set(0, FakeHdFate::stalled, on); }
    void unplug() override { fake_.set(0, FakeHdFate::unplugged, true); }
    void plug_in() override { fake_.set(0, FakeHdFate::unplugged, false); }
    void garble(bool on) override { fake_.set(0, FakeHdFate::garbled, on); }
    [[nodiscard]] std::vector<Command> commands() const override
    {
        std::vector<Command> all;
        for (const FakeHdCommand& it : fake_.commands(0)) {
            const bool zero = it.force_n[0] == 0.0 && it.force_n[1] == 0.0 && it.force_n[2] == 0.0;
            all.push_back({zero || !it.motors_on, it.motors_on});
        }
        return all;
    }

private:
    Fake fake_;
};

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<HdapiSubject>(); }

} // namespace hapnet::conformance
