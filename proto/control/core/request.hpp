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

// The requests to a control socket that are the same for every program.

/// A request that is answered once the condition holds or its time is over.
struct WaitRequest {
    base::Condition until;
    std::optional<base::Duration> timeout;
};

/// A request that is answered repeatedly, until the next request, with the statistics or with
/// frames. Frames are short and can be requested at a high rate.
struct WatchRequest {
    base::Duration every = std::chrono::milliseconds{500};
    bool of_frames = false;
};

/// A request to save recent events to a file. It is answered at once; the file appears soon after.
struct KeepRequest {
    static constexpr std::size_t name_max = 40;

    std::string name; // [a-z0-9-] only, so that the file stays in its folder
    std::optional<base::Duration> last;
};

/// The limits of a request's nesting and of its number of values. An honest request needs a nesting
/// of 3 and some hundred values. Larger requests are refused before the tree is stored, because a
/// look-up searches all of it.
inline constexpr std::size_t nesting_max = 16;
inline constexpr std::size_t values_max = 512;

/// Parses one line, and keeps the order of the members. Fails if the line is not a JSON object, is
/// nested too deeply, has too many values or repeats a member.
[[nodiscard]] base::Result<nlohmann::ordered_json> parse_object(std::string_view line);

/// Reads the members of a request, and remembers the first error.
class Members {
public:
    /// `json` must be an object, and must outlive this.
    explicit Members(const nlohmann::ordered_json& json) : json_{json} {}

    /// Returns the text of a member that is required.
    std::string text(const char* key);
    std::optional<std::string> optional_text(const char* key);
    /// Returns a time from `least` to `most`; nullopt if the member is missing or wrong.
    std::optional<base::Duration> time(const char* key, base::Duration least,
                                       base::Duration most = std::chrono::hours{24});
    /// Returns the member unchecked; nullptr if it is missing.
    const nlohmann::ordered_json* find(const char* key);
    void fail(std::string what);

    [[nodiscard]] const std::optional<std::string>& error() const { return error_; }

    /// Returns the request. Fails if there was an error, or if a member was not read.
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

/// Reads the members of wait. watch_request() reads those of watch; `frames_least` is the shortest
/// allowed interval between frames.
[[nodiscard]] WaitRequest wait_request(Members& members);
[[nodiscard]] WatchRequest watch_request(Members& members, base::Duration frames_least);

/// Reads the members of a keep request. `held` is the span of recent events that the program keeps;
/// nullopt: it keeps none.
[[nodiscard]] KeepRequest keep_request(Members& members, std::optional<base::Duration> held);

} // namespace hapnet::control
