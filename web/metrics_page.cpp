// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/metrics_page.hpp"

#include "proto/net/clock.hpp"
#include "web/core/metrics.hpp"

#include <memory>
#include <utility>

namespace hapnet::web {

namespace {

using Json = Daemon::Json;

const std::string stats_request = R"({"command":"stats"})";

void reply_with(const std::string& text, const OnReply& on_reply)
{
    on_reply({.body = text, .type = "text/plain; version=0.0.4; charset=utf-8"});
}

} // namespace

void MetricsPage::answer(Daemon* emulator, const std::vector<Daemon*>& peers,
                         const OnReply& on_reply)
{
    const auto now = net::monotonic_now();
    if (until_ && !base::is_due(until_, now)) return reply_with(text_, on_reply);
    until_ = now + kept_for;
    struct Gathered {
        Json emulator = nullptr;
        std::vector<Json> peers;
        std::size_t awaited = 1;
    };
    auto gathered = std::make_shared<Gathered>();
    const auto one_more = [this, gathered, on_reply] {
        if (--gathered->awaited > 0) return;
        text_ = prometheus_text(gathered->emulator, gathered->peers);
        reply_with(text_, on_reply);
    };
    if (emulator != nullptr) {
        ++gathered->awaited;
        emulator->ask(stats_request, [gathered, one_more](const base::Result<Json>& reply) {
            if (reply) gathered->emulator = *reply;
            one_more();
        });
    }
    for (Daemon* peer : peers) {
        ++gathered->awaited;
        peer->ask(stats_request, [gathered, one_more](const base::Result<Json>& reply) {
            if (reply) gathered->peers.push_back(*reply);
            one_more();
        });
    }
    one_more();
}

} // namespace hapnet::web
