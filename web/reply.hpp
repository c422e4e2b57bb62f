// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::web {

/// An answer to a request.
struct Reply {
    int status = 200;
    std::string body;
    std::string type = "application/json";
    std::string file{};        // path of a file to send instead of the body
    std::string attached_as{}; // the name under which a browser is to save it
};
using OnReply = std::function<void(Reply)>;

[[nodiscard]] Reply error_reply(int status, std::string_view error);
/// Returns {"ok":true,key:value}.
[[nodiscard]] Reply fine_reply(const char* key, nlohmann::ordered_json value);

/// Returns JSON on one line. Bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string text_of(const nlohmann::ordered_json& json);

} // namespace hapnet::web
