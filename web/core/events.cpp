// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/events.hpp"

namespace hapnet::web {

const nlohmann::ordered_json& Events::add(const Event& event)
{
    nlohmann::ordered_json json{{"type", "event"},       {"id", ++count_},
                                {"at_s", event.at.at_s}, {"at_unix_ms", event.at.unix_ms},
                                {"kind", event.kind},    {"text", event.text}};
    if (event.generation > 0) json["generation"] = event.generation;
    if (!event.files.empty()) json["files"] = event.files;
    if (!event.set.is_null()) json["set"] = event.set;
    if (kept_.size() == kept_max) kept_.pop_front();
    return kept_.emplace_back(std::move(json));
}

} // namespace hapnet::web
