// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/fate.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

// Fates as text: a CSV table with one row for each datagram, first all of up, then all of down,
// each in the order of their numbers. Equal fates give equal bytes, whatever the timing of the run
// that wrote them.

/// The first line, without its end:
/// - direction: up | down
/// - number: of the datagram in its direction, from 0
/// - verdict: deliver | drop
/// - cause: why it was dropped, as in the statistics
/// - states: of the laws of loss in the order of their list, joined by '/', without the last ones
///   that have none
/// - delay_ns: as it was drawn, before any queue
/// - copy_after_ns: how long after the original the copy leaves
/// - flipped_bits: places of inverted bits modulo the bits of the datagram, joined by '|'
/// - displaced_places, displaced_ns: how far behind its turn it leaves
/// A column that does not apply is empty; those from delay_ns on apply to deliver only.
inline constexpr std::string_view fates_header =
    "direction,number,verdict,cause,states,delay_ns,copy_after_ns,flipped_bits,"
    "displaced_places,displaced_ns";

/// The longest time in a fate. It ensures that no sum of such times and a time point overflows.
inline constexpr base::Duration fate_time_max = std::chrono::hours{24 * 1000};

/// The names of the regimes of one direction, in their order.
using RegimeNames = std::vector<std::string>;

/// Appends the row of a fate, with its end of line, to `text`; allocates only when `text` has to
/// grow. `regimes`: the names of the direction's regimes, in a table with that column; null: the
/// table has no such column.
void append_row(std::string& text, Direction direction, std::uint64_t number, const Fate& fate,
                const RegimeNames* regimes = nullptr);

/// The fates of both directions. Fate n is that of datagram n.
struct Fates {
    std::vector<Fate> up;
    std::vector<Fate> down;
    RegimeNames regimes_up{}; // in the order first met; Fate::regime counts them from 1
    RegimeNames regimes_down{};

    friend bool operator==(const Fates&, const Fates&) = default;
};

/// Returns the whole table.
[[nodiscard]] std::string to_text(const Fates& fates);

/// Reads the whole table. Refuses everything that to_text() would not have written; the error names
/// the line and says what was expected.
[[nodiscard]] base::Result<Fates> parse_fates(std::string_view text);

/// Returns the fates with the regimes numbered as in these lists. The error: the lists lack a
/// regime.
[[nodiscard]] base::Result<Fates> with_regimes(Fates fates, const RegimeNames& up,
                                               const RegimeNames& down);

// A table of a run with several paths has one more column in front, the name of the path. A table
// of a run with flows has another one, the name of the flow, or "rest". A table of a run with
// regimes has one behind the states, the name of the regime; it is empty where a direction has
// none. The tables of the paths follow each other.

inline constexpr std::string_view path_column = "link";
inline constexpr std::string_view flow_column = "flow";
inline constexpr std::string_view regime_column = "regime";

/// The columns that a table has in addition to those of a single path without regimes.
struct FateColumns {
    bool has_paths = false;
    bool has_flows = false;
    bool has_regimes = false;

    friend bool operator==(const FateColumns&, const FateColumns&) = default;
};

/// Returns the first line, without its end.
[[nodiscard]] std::string head_of_fates(FateColumns columns);
/// Returns the first cells of each row of a path: "1-2,voice,".
[[nodiscard]] std::string row_begin(FateColumns columns, std::string_view path);

/// The fates by the names of the paths.
using FatesOfPaths = std::map<std::string, Fates, std::less<>>;

[[nodiscard]] std::string to_text(const FatesOfPaths& fates);

/// Reads any of these tables. The only path has the name "", or that of its flow: "flow.voice".
[[nodiscard]] base::Result<FatesOfPaths> parse_fates_of_paths(std::string_view text);

} // namespace hapnet::emulator
