// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/condition.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::control {

// The requests of a control socket's clients that are the same for every program.

/// Answered once the condition holds, or its time is over.
struct WaitRequest {
    base::Condition until;
    std::optional<base::Duration> timeout;
};

/// Answered again and again, until the next request: with the statistics, or with frames, which are
/// short and may be had often.
struct WatchRequest {
    base::Duration every = std::chrono::milliseconds{500};
    bool of_frames = false;
};

/// Answered at once: what happened last is saved to a file, which appears soon after.
struct KeepRequest {
    static constexpr std::size_t name_max = 40;

    std::string name; // [a-z0-9-], so that it stays in its folder
    std::optional<base::Duration> last;
};

/// The limits of a request's nesting and of its number of values. An honest request needs a nesting
/// of 3 and some hundred values. Larger ones are refused before they are kept, because a look-up in
/// the tree searches all of it.
inline constexpr std::size_t nesting_max = 16;
inline constexpr std::size_t values_max = 512;

/// Reads one line. Keeps the order of the members. The error is for a line that is not a JSON
/// object, is nested too deeply, has too many values or repeats a member.
[[nodiscard]] base::Result<nlohmann::ordered_json> parse_object(std::string_view line);

/// The members of a request; the first trouble is remembered.
class Members {
public:
    /// `json` is an object, and outlives this.
    explicit Members(const nlohmann::ordered_json& json) : json_{json} {}

    /// A text that must be there.
    std::string text(const char* key);
    std::optional<std::string> optional_text(const char* key);
    /// A time from `least` to `most`.
    std::optional<base::Duration> time(const char* key, base::Duration least,
                                       base::Duration most = std::chrono::hours{24});
    /// The member as it is; null when it is not there.
    const nlohmann::ordered_json* find(const char* key);
    void fail(std::string what);

    [[nodiscard]] const std::optional<std::string>& error() const { return error_; }

    /// The request, if nothing was wrong and nothing is left over.
    template <typename Request>
    base::Result<Request> finish(Request request)
    {
        refuse_the_rest();
        if (error_) return base::fail(*error_);
        return request;
    }

private:
    void refuse_the_rest();

    const nlohmann::ordered_json& json_;
    std::vector<std::string_view> known_;
    std::optional<std::string> error_;
};

/// The members of wait and of watch. `frames_least`: how often frames may be had.
[[nodiscard]] WaitRequest wait_request(Members& members);
[[nodiscard]] WatchRequest watch_request(Members& members, base::Duration frames_least);

/// Reads the members of a keep request. `held` is how much of the last events the program has;
/// nullopt: nothing.
[[nodiscard]] KeepRequest keep_request(Members& members, std::optional<base::Duration> held);

} // namespace hapnet::control
