// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/json_file.hpp"

#include "proto/net/text_file.hpp"

namespace hapnet::lab {

base::Result<nlohmann::ordered_json> read_json(const std::string& path)
{
    const auto text = net::text_of_file(path);
    if (!text) return tl::unexpected{text.error()};
    auto json = nlohmann::ordered_json::parse(*text, nullptr, false);
    if (!json.is_object()) return base::fail(path + " does not hold one JSON object");
    return json;
}

} // namespace hapnet::lab
