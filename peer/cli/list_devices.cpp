// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/list_devices.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

namespace {

/// Returns the name in the form that --device accepts.
std::string name_of(const device::Identity& identity)
{
    if (identity.serial.empty()) return identity.backend;
    return fmt::format("{}:{}", identity.backend, identity.serial);
}

} // namespace

std::string device_table(const std::vector<device::Found>& found)
{
    if (found.empty()) {
        return "No haptic device found. Run hapnet-peer doctor to find out why. --device sim needs "
               "no hardware.\n";
    }
    std::size_t width = 6;
    for (const auto& one : found) width = std::max(width, name_of(one.identity).size());
    std::string text = fmt::format("{:<{}}  {:<16}  {}\n", "DEVICE", width, "STATE", "WHAT IT IS");
    for (const auto& one : found) {
        const auto& identity = one.identity;
        text += fmt::format("{:<{}}  {:<16}  {}{}\n", name_of(identity), width,
                            one.unusable ? device::name_of(one.unusable->fault) : "usable",
                            identity.model,
                            identity.note.empty() ? "" : fmt::format(" ({})", identity.note));
    }
    for (const auto& one : found) {
        if (!one.unusable) continue;
        text += fmt::format("\n{}: {}\n", name_of(one.identity), one.unusable->message);
    }
    return text;
}

std::string device_json(const std::vector<device::Found>& found)
{
    auto devices = nlohmann::json::array();
    for (const auto& one : found) {
        nlohmann::json row{{"device", name_of(one.identity)},
                           {"backend", one.identity.backend},
                           {"serial", one.identity.serial},
                           {"model", one.identity.model},
                           {"note", one.identity.note},
                           {"usable", !one.unusable.has_value()},
                           {"fault", nullptr},
                           {"message", nullptr},
                           {"code", nullptr}};
        if (one.unusable) {
            row["fault"] = device::name_of(one.unusable->fault);
            row["message"] = one.unusable->message;
            row["code"] = one.unusable->code;
        }
        devices.push_back(std::move(row));
    }
    return nlohmann::json{{"devices", devices}}.dump(2) + "\n";
}

} // namespace hapnet::peer
