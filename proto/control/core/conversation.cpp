// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/core/conversation.hpp"

#include "proto/base/ensure.hpp"
#include "proto/control/core/condition.hpp"
#include "proto/control/core/reply.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::control {

namespace {

using namespace std::chrono_literals;

/// The interval at which the condition of a waiting client is checked. Each check costs about 0.1
/// ms.
constexpr base::Duration look_every = 100ms;

} // namespace

std::size_t Conversation::room() const
{
    // One byte more than the longest line, so that a line that is too long can be detected.
    return has_ended_ ? 0 : line_max_ + 1 - input_.size();
}

void Conversation::on_bytes(std::string_view bytes)
{
    base::ensure(bytes.size() <= room());
    input_ += bytes;
}

void Conversation::on_gone()
{
    is_gone_ = true;
    has_ended_ = true;
    pending_ = {};
    output_.clear();
    written_ = 0;
}

bool Conversation::advance(const Subject& subject, base::TimePoint now)
{
    if (output().size() >= unread_bytes_max) return false;
    if (auto* waiting = std::get_if<Waiting>(&pending_)) return look(*waiting, subject, now);
    if (const auto line = next_line()) {
        pending_ = {};
        answer(*line, subject, now);
        if (is_gone_) pending_ = {};
        return true;
    }
    if (auto* watching = std::get_if<Watching>(&pending_)) return show(*watching, subject, now);
    return false;
}

std::optional<std::string> Conversation::next_line()
{
    const auto end = input_.find('\n', searched_);
    if (end == std::string::npos && !(has_ended_ && !input_.empty())) {
        searched_ = input_.size();
        if (input_.size() <= line_max_) return std::nullopt;
    }
    std::string line = input_.substr(0, end);
    input_.erase(0, end == std::string::npos ? end : end + 1);
    searched_ = 0;
    return line;
}

void Conversation::answer(const std::string& line, const Subject& subject, base::TimePoint now)
{
    if (line.size() > line_max_) {
        send(refusal(fmt::format("a line of more than {} bytes", line_max_)), now);
        has_ended_ = true; // the bytes that follow are the rest of that line, not a request
        input_.clear();
        return;
    }
    const Answer answer = subject.answer(line, now);
    if (const auto* wait = std::get_if<WaitRequest>(&answer)) {
        begin(*wait, subject, now);
    } else if (const auto* watch = std::get_if<WatchRequest>(&answer)) {
        begin(*watch, subject, now);
    } else {
        send(std::get<std::string>(answer), now);
    }
}

void Conversation::begin(const WaitRequest& request, const Subject& subject, base::TimePoint now)
{
    Waiting waiting{request, now, std::nullopt};
    if (request.timeout) waiting.end = now + *request.timeout;
    pending_ = waiting;
    look(std::get<Waiting>(pending_), subject, now);
}

bool Conversation::look(Waiting& waiting, const Subject& subject, base::TimePoint now)
{
    const bool is_end = base::is_due(waiting.end, now);
    if (now < waiting.next_look && !is_end) return false;
    waiting.next_look = now + look_every;
    const base::Condition& until = waiting.request.until;
    const auto statistics = subject.statistics();
    const auto met = is_met(until, statistics);
    if (met && !*met && !is_end) return false;
    send(met ? wait_reply(until, *met, statistics) : refusal(met.error().message), now);
    pending_ = {};
    return true;
}

void Conversation::begin(const WatchRequest& request, const Subject& subject, base::TimePoint now)
{
    if (!request.of_frames) {
        pending_ = Watching{request, now};
    } else if (subject.frames) {
        pending_ = Watching{request, now, subject.frames()};
    } else {
        send(refusal("this program has no frames; leave \"what\" out"), now);
    }
}

bool Conversation::show(Watching& watching, const Subject& subject, base::TimePoint now)
{
    if (now < watching.next_line) return false;
    watching.next_line = std::max(watching.next_line + watching.request.every, now);
    if (watching.request.of_frames) {
        send_frame(watching, now);
        return false;
    }
    // A slow reader gets the newest line when it is ready for one, and not all lines.
    if (output().empty()) send(statistics_reply(subject.statistics()), now);
    return false;
}

void Conversation::send_frame(Watching& watching, base::TimePoint now)
{
    if (output().size() > unread_frames_bytes_max) {
        ++watching.left_out;
        return;
    }
    if (output().empty()) last_progress_ = now;
    const std::size_t before = output_.size();
    watching.frames(output_, watching.left_out);
    if (output_.size() == before) return;
    output_ += '\n';
    watching.left_out = 0;
}

std::optional<base::TimePoint> Conversation::next_deadline() const
{
    std::optional<base::TimePoint> next;
    if (!output().empty()) next = last_progress_ + patience;
    if (output().size() >= unread_bytes_max) return next;
    if (const auto* waiting = std::get_if<Waiting>(&pending_)) {
        return base::earlier(next, base::earlier(waiting->next_look, waiting->end));
    }
    if (const auto* watching = std::get_if<Watching>(&pending_)) {
        return base::earlier(next, watching->next_line);
    }
    return next;
}

std::string_view Conversation::output() const { return std::string_view{output_}.substr(written_); }

void Conversation::send(std::string_view line, base::TimePoint now)
{
    if (is_gone_) return;
    if (output().empty()) last_progress_ = now;
    output_ += line;
    output_ += '\n';
}

void Conversation::on_written(std::size_t bytes, base::TimePoint now)
{
    base::ensure(bytes <= output().size());
    written_ += bytes;
    if (bytes > 0) last_progress_ = now;
    if (written_ < output_.size() && written_ < unread_frames_bytes_max) return;
    output_.erase(0, written_); // a reader of frames that never catches up must not fill the memory
    written_ = 0;
}

bool Conversation::is_over() const
{
    return has_ended_ && input_.empty() && std::holds_alternative<std::monostate>(pending_);
}

bool Conversation::is_stuck(base::TimePoint now) const
{
    return !output().empty() && now - last_progress_ >= patience;
}

} // namespace hapnet::control
