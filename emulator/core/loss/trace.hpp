// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "emulator/core/trace/rows.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// The losses of a recorded run, datagram by datagram. The trace begins again at its end. It has at
/// least one datagram.
class LossTrace {
public:
    static constexpr std::size_t datagrams_max = 10'000'000;

    /// Ensures that there are at least one and at most datagrams_max datagrams.
    explicit LossTrace(std::vector<bool> lost);

    [[nodiscard]] bool is_lost(std::uint64_t number) const { return lost_[number % lost_.size()]; }
    [[nodiscard]] std::size_t size() const { return lost_.size(); }
    [[nodiscard]] std::size_t losses() const { return losses_; }

    friend bool operator==(const LossTrace&, const LossTrace&) = default;

private:
    std::vector<bool> lost_;
    std::size_t losses_;
};

/// Reads a file of 0 (arrived) and 1 (lost), one after the other. Blanks and line ends between them
/// have no meaning, and '#' begins a comment. Errors name the line.
[[nodiscard]] base::Result<LossTrace> parse_loss_trace(std::string_view text);

/// Reads the column `lost` (0 or 1) of a table, or the one that the format names. Without such a
/// column, the column of delays shows which datagrams were lost (see read_trace_rows). Errors name
/// the line.
[[nodiscard]] base::Result<LossTrace> parse_loss_table(std::string_view text,
                                                       const TableFormat& format = {});

/// Repeats the losses of a recorded run. The trace begins again at its end.
struct TraceLoss {
    std::string file;
    std::shared_ptr<const LossTrace> trace; // never null
    std::string columns{};

    static constexpr DropCause cause = DropCause::trace_loss;
    static constexpr bool is_in_time = false;
    class Model;

    /// Reads the file.
    [[nodiscard]] base::Result<void> load(const base::Reading& reading);
    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    /// Compares the contents: a file that was read twice gives equal laws.
    friend bool operator==(const TraceLoss&, const TraceLoss&);
};

constexpr auto fields_of(base::Tag<TraceLoss>)
{
    return base::fields(
        "trace",
        base::field("file", &TraceLoss::file,
                    "a file of 0 (arrived) and 1 (lost), CSV with a column `lost`, or delays of "
                    "which some say `lost`")
            .required(),
        base::field("columns", &TraceLoss::columns,
                    "columns of CSV with other names: \"lost=gone\" or \"delay=rtt:ms\""));
}

class TraceLoss::Model {
public:
    Model(const TraceLoss& law, const base::RandomStream& stream) { change(law, stream); }

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream&) const
    {
        return trace_->is_lost(packet.number);
    }
    void change(const TraceLoss& law, const base::RandomStream&);

private:
    std::shared_ptr<const LossTrace> trace_;
};

} // namespace hapnet::emulator
