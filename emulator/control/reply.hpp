// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/emulation.hpp"
#include "emulator/control/request.hpp"
#include "proto/base/time.hpp"
#include "proto/control/core/conversation.hpp"
#include "proto/output/metrics.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::emulator {

// Lines that answer requests, each a JSON object without a newline. Call these functions on the
// thread of the control.

[[nodiscard]] std::string reply_to(const ShowRequest& request, Emulation& emulation,
                                   base::TimePoint now);
[[nodiscard]] std::string reply_to(const SetRequest& request, Emulation& emulation,
                                   base::TimePoint now);
[[nodiscard]] std::string reply_to(const ApplyRequest& request, Emulation& emulation,
                                   base::TimePoint now);
[[nodiscard]] std::string reply_to(const DiffRequest& request, Emulation& emulation,
                                   base::TimePoint now);
[[nodiscard]] std::string reply_to(const ResetRequest& request, Emulation& emulation,
                                   base::TimePoint now);
[[nodiscard]] std::string reply_to(const KeepRequest& request, const Emulation& emulation,
                                   base::TimePoint now);

/// Returns the emulator's statistics with "generation" and "elapsed_s".
[[nodiscard]] nlohmann::ordered_json statistics_of(Emulation& emulation);

/// Returns the metrics in the statistics of a run. In a run with several links, each link has its
/// own.
[[nodiscard]] output::Metrics metrics_of(nlohmann::ordered_json statistics);

/// Returns the answer to a request, or the condition or interval that the client waits for.
[[nodiscard]] control::Answer answer_to(std::string_view line, Emulation& emulation,
                                        base::TimePoint now);

/// Returns the emulator as its clients see it. `emulation` must outlive the result.
[[nodiscard]] control::Subject subject_of(Emulation& emulation);

} // namespace hapnet::emulator
