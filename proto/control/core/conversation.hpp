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

/// One watch of frames, which ends when this object is destroyed. A call appends the frame of all
/// events since the last frame, as a JSON object without a newline. It appends nothing if there is
/// no frame yet. `left_out` is the number of frames since then that were due but not sent.
using FrameSource = std::function<void(std::string& text, std::uint64_t left_out)>;

/// The program that answers requests, as its clients see it. The thread that serves the clients
/// calls these functions.
struct Subject {
    std::function<Answer(std::string_view line, base::TimePoint now)> answer;
    /// Returns the statistics as a JSON object. Wait requests check it, and watches send it.
    std::function<nlohmann::ordered_json()> statistics;
    /// Begins a watch of frames. null: this program has no frames.
    std::function<FrameSource()> frames{};
};

/// One client of a control socket. Input and output are lines of JSON, with one reply to each
/// request in the order of the requests. Does no I/O and reads no clock. Its memory is bounded: it
/// accepts at most room() bytes of input, and answers no request while the client leaves too much
/// output unread.
class Conversation {
public:
    /// The length of the longest request, enough for whole profiles.
    static constexpr std::size_t line_bytes_max = std::size_t{1} << 20;
    static constexpr std::size_t unread_bytes_max = std::size_t{256} << 10;
    /// The limit of unread bytes above which frames are left out, because only the newest frame is
    /// of use.
    static constexpr std::size_t unread_frames_bytes_max = std::size_t{64} << 10;
    /// The time after which a client that reads nothing of its output is given up.
    static constexpr base::Duration patience = std::chrono::seconds{10};

    /// A line of more than `line_max` bytes is refused, and no later input is read.
    explicit Conversation(std::size_t line_max = line_bytes_max) : line_max_{line_max} {}

    /// Returns the number of bytes that on_bytes() accepts now.
    [[nodiscard]] std::size_t room() const;

    /// Takes bytes that the client has sent, at most room() bytes.
    void on_bytes(std::string_view bytes);

    /// Notes that the client will send nothing more. Requests that it has sent are still answered.
    void on_end() { has_ended_ = true; }

    /// Notes that the client has disconnected. Its requests are still carried out, but no reply is
    /// sent.
    void on_gone();
    [[nodiscard]] bool is_gone() const { return is_gone_; }

    /// Does one step: answers a request, checks the waiting one, or sends a line of a watch.
    /// Returns true if another step may follow at once.
    bool advance(const Subject& subject, base::TimePoint now);

    /// Returns when to call advance() again although nothing was received; nullopt: never.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const;

    /// Returns the bytes to send. Report the number of sent bytes with on_written().
    [[nodiscard]] std::string_view output() const;
    void on_written(std::size_t bytes, base::TimePoint now);

    /// True if no more output will come. Close the connection once output() is empty.
    [[nodiscard]] bool is_over() const;

    /// True if the client does not read its replies. Close the connection then.
    [[nodiscard]] bool is_stuck(base::TimePoint now) const;

private:
    /// A request that waits for its condition.
    struct Waiting {
        WaitRequest request;
        base::TimePoint next_look;
        std::optional<base::TimePoint> end;
    };
    /// Statistics or frames that are sent at intervals, until the next request.
    struct Watching {
        WatchRequest request;
        base::TimePoint next_line;
        FrameSource frames{}; // nullptr: a watch of statistics
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
    std::size_t searched_ = 0; // length of the prefix of input_ that is known to hold no newline
    std::string output_;
    std::size_t written_ = 0; // bytes of output_ that have been sent
    base::TimePoint last_progress_{};
    std::variant<std::monostate, Waiting, Watching> pending_;
    bool has_ended_ = false;
    bool is_gone_ = false;
};

} // namespace hapnet::control
