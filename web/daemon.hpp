// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "web/wire.hpp"

#include <deque>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::web {

/// A running emulator or peer. One connection carries its frames, another one requests and replies.
class Daemon {
public:
    using Json = nlohmann::ordered_json;
    /// Receives the reply, which may be a refusal; an error: there is no reply.
    using OnReply = std::function<void(const base::Result<Json>& reply)>;
    struct Handlers {
        std::function<void()> on_attached;
        std::function<void(std::string_view line)> on_frame;
        std::function<void(const std::string& why)> on_lost;
    };

    static constexpr base::Duration patience{std::chrono::seconds{2}};
    static constexpr std::size_t asked_max = 64;

    /// `every` is the interval of frames.
    Daemon(boost::asio::io_context& io, const std::string& path, std::string every,
           Handlers handlers);

    /// Sends a request. `on_reply` is called within `patience`.
    void ask(const std::string& request, OnReply on_reply);

    /// Gives up requests that were not answered in time. Call it regularly.
    void tick(base::TimePoint now);

    [[nodiscard]] bool is_attached() const { return asking_.is_open(); }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    struct Asked {
        OnReply on_reply;
        base::TimePoint deadline;
    };

    void on_reply(std::string_view line);
    void give_up(const std::string& why);

    std::string path_;
    Handlers handlers_;
    std::deque<Asked> asked_;
    bool is_told_ = false; // on_attached() was called, on_lost() not yet
    Wire watching_;
    Wire asking_;
};

} // namespace hapnet::web
