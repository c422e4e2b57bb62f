// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/core/condition.hpp"

#include "proto/base/reading.hpp"

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::control {

namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string_view> keys_of(const Json& object)
{
    std::vector<std::string_view> keys;
    for (auto member = object.begin(); member != object.end(); ++member) {
        keys.push_back(member.key());
    }
    return keys;
}

/// Finds the value at a path. It is null if the path continues below a null, whose parts do not
/// exist yet. If the path is wrong, the error lists the keys at that point.
base::Result<const Json*> find(std::string_view path, const Json& statistics)
{
    const Json* place = &statistics;
    std::string passed;
    while (place->is_object()) {
        const auto dot = path.find('.');
        const std::string key{path.substr(0, dot)};
        const auto next = place->find(key);
        if (next == place->end()) {
            return base::fail(fmt::format("there is no '{}' in {}: {}", key,
                                          passed.empty() ? "the statistics" : passed,
                                          base::suggestion(key, keys_of(*place))));
        }
        passed += (passed.empty() ? "" : ".") + key;
        place = &*next;
        if (dot == std::string_view::npos) break;
        path.remove_prefix(dot + 1);
        if (place->is_null()) return place;
        if (!place->is_object()) {
            return base::fail(fmt::format("'{}' is a single value, without parts", passed));
        }
    }
    if (place->is_object()) {
        return base::fail(fmt::format("'{}' has parts: name one of {}", passed,
                                      fmt::join(keys_of(*place), ", ")));
    }
    return place;
}

} // namespace

base::Result<std::optional<double>> value_in(const Json& statistics,
                                             const base::Condition& condition)
{
    const auto found = find(condition.path, statistics);
    if (!found) return tl::unexpected{found.error()};
    const Json& value = **found;
    if (value.is_null()) return std::optional<double>{};
    if (value.is_boolean()) return std::optional{value.get<bool>() ? 1.0 : 0.0};
    if (value.is_number()) return std::optional{value.get<double>()};
    return base::fail(fmt::format("'{}' is not a number", condition.path));
}

base::Result<bool> is_met(const base::Condition& condition, const Json& statistics)
{
    return value_in(statistics, condition).map([&](std::optional<double> value) {
        return value && holds(condition, *value);
    });
}

} // namespace hapnet::control
