// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/reply.hpp"

#include <utility>

namespace hapnet::web {

std::string text_of(const nlohmann::ordered_json& json)
{
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

Reply error_reply(int status, std::string_view error)
{
    return {.status = status,
            .body = text_of(nlohmann::ordered_json{{"ok", false}, {"error", error}})};
}

Reply fine_reply(const char* key, nlohmann::ordered_json value)
{
    nlohmann::ordered_json json{{"ok", true}};
    json[key] = std::move(value);
    return {.body = text_of(json)};
}

} // namespace hapnet::web
