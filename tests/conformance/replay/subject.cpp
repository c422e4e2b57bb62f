// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/conformance/subject.hpp"
#include "device/replay/replay.hpp"

#include <chrono>

namespace hapnet::conformance {

namespace {

/// A recording is its own double.
class ReplaySubject final : public Subject {
public:
    [[nodiscard]] Traits traits() const override { return only_software; }
    [[nodiscard]] device::Opened<std::unique_ptr<device::Device>> open() override
    {
        device::HandTrace trace{{0.0, {}, false}, {1.0, {{0.01, 0.0, 0.0}}, true}};
        return std::make_unique<device::Replay>(std::move(trace), "hand.csv");
    }
    [[nodiscard]] base::TimePoint now() override { return now_; }
    void pass(base::Duration duration) override { now_ += duration; }
    [[nodiscard]] std::vector<Command> commands() const override { return {}; }

private:
    base::TimePoint now_{std::chrono::seconds{1000}};
};

} // namespace

std::unique_ptr<Subject> make_subject() { return std::make_unique<ReplaySubject>(); }

} // namespace hapnet::conformance
