// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/metrics_page.hpp"

#include "proto/net/clock.hpp"
#include "proto/output/metrics.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace hapnet::web {

namespace {

using Json = Daemon::Json;

const std::string metrics_request = R"({"command":"metrics"})";

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
    std::vector<Daemon*> daemons = peers;
    if (emulator != nullptr) daemons.insert(daemons.begin(), emulator);
    struct Gathered {
        std::vector<Json> replies; // in the order of the daemons, not of arrival
        std::size_t awaited = 1;
    };
    auto gathered = std::make_shared<Gathered>();
    gathered->replies.resize(daemons.size());
    const auto one_more = [this, gathered, on_reply] {
        if (--gathered->awaited > 0) return;
        output::Metrics metrics;
        for (const Json& reply : gathered->replies) {
            if (reply.contains("metrics")) metrics.add(reply.at("metrics"));
        }
        text_ = metrics.text();
        reply_with(text_, on_reply);
    };
    for (std::size_t i = 0; i < daemons.size(); ++i) {
        ++gathered->awaited;
        daemons[i]->ask(metrics_request, [gathered, one_more, i](const base::Result<Json>& reply) {
            if (reply) gathered->replies[i] = *reply;
            one_more();
        });
    }
    one_more();
}

} // namespace hapnet::web
