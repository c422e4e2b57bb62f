// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "web/daemon.hpp"
#include "web/reply.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hapnet::web {

/// GET /metrics: the metrics of all daemons as text for Prometheus. The daemons receive a request
/// at most once a second, however many clients scrape.
class MetricsPage {
public:
    static constexpr base::Duration kept_for{std::chrono::seconds{1}};

    /// Answers with the metrics of the attached daemons. `emulator` may be null.
    void answer(Daemon* emulator, const std::vector<Daemon*>& peers, const OnReply& on_reply);

private:
    std::string text_;
    std::optional<base::TimePoint> until_;
};

} // namespace hapnet::web
