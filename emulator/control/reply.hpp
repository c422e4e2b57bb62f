// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/emulation.hpp"
#include "emulator/control/request.hpp"
#include "proto/base/time.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::emulator {

// The lines that answer requests, each a JSON object without a newline.

/// {"ok":false,"error":"..."}; what is too long to be read is cut.
[[nodiscard]] std::string refusal(std::string_view error);

/// The same, to one client too many: {"ok":false,"busy":true,"error":"..."}.
[[nodiscard]] std::string busy_refusal();

[[nodiscard]] std::string reply_to(const ShowRequest& request, const Emulation& emulation);
[[nodiscard]] std::string reply_to(const SetRequest& request, Emulation& emulation,
                                   base::TimePoint now);
[[nodiscard]] std::string reply_to(const ApplyRequest& request, Emulation& emulation,
                                   base::TimePoint now);
[[nodiscard]] std::string reply_to(const DiffRequest& request, const Emulation& emulation);
[[nodiscard]] std::string reply_to(const ResetRequest& request, Emulation& emulation,
                                   base::TimePoint now);

/// The answer to stats, and each line of a watch.
[[nodiscard]] std::string statistics_reply(const Emulation& emulation);

/// The answer to wait.
[[nodiscard]] std::string wait_reply(const Condition& until, bool is_met,
                                     const Emulation& emulation);

/// The emulator's statistics with "generation" and "elapsed_s".
[[nodiscard]] nlohmann::ordered_json statistics_of(const Emulation& emulation);

/// Does what is asked, and hands the conditions on when they have changed.
[[nodiscard]] base::Result<void> carry_out(const Command& command, Emulation& emulation,
                                           base::TimePoint now);

} // namespace hapnet::emulator
