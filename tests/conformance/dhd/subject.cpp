// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/dhd/transport/dhds.hpp"
#include "proto/net/clock.hpp"
#include "tests/conformance/dhd/fake.hpp"

namespace hapnet::conformance {

namespace {

/// The backend on the fake libdhd, through dlopen and in real time: the device has a thread of its
/// own.
class DhdSubject final : public Subject {
public:
    ~DhdSubject() override { fake_.set(FakeDhdFate::stalled, false); } // its thread may go

    [[nodiscard]] Traits traits() const override { return {.calibrates = true}; }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        return device::dhd::open_dhd("4711", HAPNET_FAKE_DHD);
    }
    [[nodiscard]] base::TimePoint now() override { return net::monotonic_now(); }
    void pass(base::Duration duration) override { net::sleep_until(now() + duration); }
    void help_calibrate() override { fake_.set(FakeDhdFate::calibrated, true); }
    void press(bool down) override { fake_.set(FakeDhdFate::pressed, down); }
    void stall(bool on) override { fake_.set(FakeDhdFate::stalled, on); }
    void unplug() override { fake_.set(FakeDhdFate::unplugged, true); }
    void plug_in() override { fake_.set(FakeDhdFate::unplugged, false); }
    void garble(bool on) override { fake_.set(FakeDhdFate::garbled, on); }
    [[nodiscard]] std::vector<Command> commands() const override
    {
        std::vector<Command> all;
        for (const FakeDhdCommand& it : fake_.commands()) {
            const bool zero = it.force_n[0] == 0.0 && it.force_n[1] == 0.0 && it.force_n[2] == 0.0;
            all.push_back({zero || !it.motors_on, it.motors_on});
        }
        return all;
    }

private:
    FakeDhd fake_;
};

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<DhdSubject>(); }

} // namespace hapnet::conformance
