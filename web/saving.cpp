// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/saving.hpp"

#include "proto/base/text.hpp"
#include "web/reply.hpp"

#include <algorithm>
#include <unistd.h>
#include <utility>

namespace hapnet::web {

void Saving::begin(const std::vector<Daemon*>& daemons, const std::string& name,
                   base::Duration last, OnSaved on_saved)
{
    if (pending_) return on_saved(base::fail("the last seconds are being saved already"));
    if (daemons.empty()) return on_saved(base::fail("nothing is attached"));
    auto pending = std::make_shared<Pending>();
    pending->awaited = daemons.size();
    pending->on_saved = std::move(on_saved);
    pending_ = pending;
    const std::string request =
        text_of(Daemon::Json{{"command", "keep"}, {"name", name}, {"last", base::to_text(last)}});
    for (Daemon* daemon : daemons) {
        daemon->ask(request, [pending](const base::Result<Daemon::Json>& reply) {
            --pending->awaited;
            if (!reply) {
                pending->refused = reply.error().message;
            } else if (reply->value("ok", false) && reply->contains("file") &&
                       (*reply)["file"].is_string()) {
                pending->files.push_back((*reply)["file"].get<std::string>());
            } else if (reply->contains("error") && (*reply)["error"].is_string()) {
                pending->refused = (*reply)["error"].get<std::string>();
            }
        });
    }
}

void Saving::tick(base::TimePoint now)
{
    if (!pending_ || pending_->awaited > 0) return;
    if (!pending_->until) pending_->until = now + patience;
    const bool are_there = std::ranges::all_of(
        pending_->files, [](const std::string& file) { return access(file.c_str(), F_OK) == 0; });
    if (!are_there && !base::is_due(pending_->until, now)) return;
    const auto done = std::exchange(pending_, nullptr);
    if (done->files.empty()) return done->on_saved(base::fail(done->refused));
    done->on_saved(done->files);
}

} // namespace hapnet::web
