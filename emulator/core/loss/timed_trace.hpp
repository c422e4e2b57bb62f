// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "emulator/core/trace/rows.hpp"
#include "emulator/core/trace/timing.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// The share of datagrams that is lost at each time.
class LossSeries {
public:
    /// `times` ascend from 0, and there is one for each share.
    LossSeries(std::vector<double> shares, std::vector<base::Duration> times);

    /// Returns the share that is lost at a time since the trace began, from 0 to 1.
    [[nodiscard]] double at(base::Duration time, Interpolation way, bool repeats) const;

    friend bool operator==(const LossSeries&, const LossSeries&) = default;

private:
    std::vector<double> shares_;
    TimeAxis axis_;
};

/// Reads a table of times, or with slots, and of shares or delays (see read_trace_rows). A delay
/// counts as a share of 0, and a lost datagram as a share of 1. The error names the line.
[[nodiscard]] base::Result<LossSeries> parse_loss_series(std::string_view text,
                                                         const TableFormat& format = {});

/// Loses each datagram with the share that a trace has at its time.
struct TimedTraceLoss {
    std::string file;
    std::shared_ptr<const LossSeries> trace; // never null
    std::string columns{};
    Interpolation interpolate = Interpolation::step;
    TraceTiming timing{};

    static constexpr DropCause cause = DropCause::trace_loss;
    static constexpr bool is_in_time = true;
    class Model;

    /// Reads the file.
    [[nodiscard]] base::Result<void> load(const base::Reading& reading);
    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals& arrivals) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts& facts) const;

    /// Compares the contents: a file that was read twice gives equal laws.
    friend bool operator==(const TimedTraceLoss& a, const TimedTraceLoss& b);
};

constexpr auto fields_of(base::Tag<TimedTraceLoss>)
{
    return base::fields(
        "timed-trace",
        base::field("file", &TimedTraceLoss::file,
                    "CSV of times and shares `loss`, or of delays of which some say `lost`")
            .required(),
        base::field("columns", &TimedTraceLoss::columns,
                    "columns of CSV with other names: \"time=stamp:s, loss=lost_share\""),
        base::field("interpolate", &TimedTraceLoss::interpolate,
                    "whether a share holds until the next one, or goes there in a straight line"),
        base::part(&TimedTraceLoss::timing));
}

class TimedTraceLoss::Model {
public:
    Model(const TimedTraceLoss& law, const base::RandomStream& stream);

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream& stream);

    /// Changes the law. If trace and timing are the same, the trace continues.
    void change(const TimedTraceLoss& law, const base::RandomStream& stream);

private:
    std::shared_ptr<const LossSeries> trace_;
    Interpolation interpolate_;
    TraceClock clock_;
};

} // namespace hapnet::emulator
