// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/control/core/request.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace hapnet::control {

/// The result of a request: the reply line, without its newline, or the event that the client waits
/// for.
using Answer = std::variant<std::string, WaitRequest, WatchRequest>;

/// One watch of frames, which ends when this is destroyed. Appends the frame of all events since
/// the last frame, as a JSON object without a newline; nothing if there is no frame yet.
/// `left_out`: number of frames that were due since then.
using FrameSource = std::function<void(std::string& text, std::uint64_t left_out)>;

/// The program that is asked, as its clients see it. Called from the thread that serves them.
struct Subject {
    std::function<Answer(std::string_view line, base::TimePoint now)> answer;
    /// An object; what waits looks at it, and what watches is sent it.
    std::function<nlohmann::ordered_json()> statistics;
    /// Begins a watch of frames; null: this program has none.
    std::function<FrameSource()> frames{};
};

/// One client of a control socket: lines of JSON in, lines of JSON out, one reply to each request
/// in the order of the requests. Does no I/O and reads no clock. Bounded: it takes no more input
/// than room() says, and answers nothing more while the client leaves too much unread.
class Conversation {
public:
    /// Longest request, for whole profiles.
    static constexpr std::size_t line_bytes_max = std::size_t{1} << 20;
    static constexpr std::size_t unread_bytes_max = std::size_t{256} << 10;
    /// If more bytes than this are unread, frames are left out: the newest frame is the most
    /// useful.
    static constexpr std::size_t unread_frames_bytes_max = std::size_t{64} << 10;
    /// The time after which a client is given up that takes nothing of what it is sent.
    static constexpr base::Duration patience = std::chrono::seconds{10};

    /// A line of more than `line_max` bytes is refused, and the client heard no more.
    explicit Conversation(std::size_t line_max = line_bytes_max) : line_max_{line_max} {}

    /// Returns the number of bytes that on_bytes() accepts now.
    [[nodiscard]] std::size_t room() const;

    /// Takes bytes that the client has sent, at most room() bytes.
    void on_bytes(std::string_view bytes);

    /// The client will send no more; what it has asked is still answered.
    void on_end() { has_ended_ = true; }

    /// The client has disconnected. Its requests are still carried out, and no reply is sent.
    void on_gone();
    [[nodiscard]] bool is_gone() const { return is_gone_; }

    /// One step: answers one request, or looks at the one that waits. Returns whether it did
    /// something that may be followed by more at once.
    bool advance(const Subject& subject, base::TimePoint now);

    /// Returns when to call advance() again although nothing was received; nullopt: never.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const;

    /// The bytes to send. on_written() says how many of them have been sent.
    [[nodiscard]] std::string_view output() const;
    void on_written(std::size_t bytes, base::TimePoint now);

    /// True if nothing more will come: close the connection once output() is empty.
    [[nodiscard]] bool is_over() const;

    /// True if the client leaves its replies unread: close the connection.
    [[nodiscard]] bool is_stuck(base::TimePoint now) const;

private:
    /// A request that waits for its condition.
    struct Waiting {
        WaitRequest request;
        base::TimePoint next_look;
        std::optional<base::TimePoint> end;
    };
    /// Statistics or frames at intervals, until the next request.
    struct Watching {
        WatchRequest request;
        base::TimePoint next_line;
        FrameSource frames{}; // source of the frames; null: a watch of statistics
        std::uint64_t left_out = 0;
    };

    [[nodiscard]] std::optional<std::string> next_line();
    void answer(const std::string& line, const Subject& subject, base::TimePoint now);
    void begin(const WaitRequest& request, const Subject& subject, base::TimePoint now);
    bool look(Waiting& waiting, const Subject& subject, base::TimePoint now);
    void begin(const WatchRequest& request, const Subject& subject, base::TimePoint now);
    bool show(Watching& watching, const Subject& subject, base::TimePoint now);
    void send_frame(Watching& watching, base::TimePoint now);
    void send(std::string_view line, base::TimePoint now);

    std::size_t line_max_;
    std::string input_;
    std::size_t searched_ = 0; // first bytes of input_ that are known to hold no newline
    std::string output_;
    std::size_t written_ = 0; // bytes of output_ that have been sent
    base::TimePoint last_progress_{};
    std::variant<std::monostate, Waiting, Watching> pending_;
    bool has_ended_ = false;
    bool is_gone_ = false;
};

} // namespace hapnet::control
