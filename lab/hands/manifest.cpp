// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/manifest.hpp"

#include "proto/base/fields_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::hands {

namespace {

/// Reports values that no import could have written.
base::Result<void> check(const Manifest& manifest, const std::string& source)
{
    if (manifest.version != 1) {
        return base::fail(fmt::format("{}: 'version' is {}, and this program reads 1: import the "
                                      "recordings again",
                                      source, manifest.version));
    }
    if (manifest.trials.empty()) return base::fail(source + ": there are no trials");
    std::set<std::pair<std::string_view, std::string_view>> names;
    for (const ImportedTrial& trial : manifest.trials) {
        for (const std::string& name : {trial.subject, trial.trial}) {
            if (is_plain_name(name)) continue;
            return base::fail(fmt::format("{}: '{}' names no subject or trial: use letters, "
                                          "digits, - and _",
                                          source, name));
        }
        const auto is_file = [](const ImportedHand& hand) {
            return hand.script.ends_with(".csv") &&
                   is_plain_name(std::string_view{hand.script}.substr(0, hand.script.size() - 4));
        };
        if (!is_file(trial.a) || (trial.b && !is_file(*trial.b)))
            return base::fail(fmt::format("{}: a script of subject {} is not a file of this folder",
                                          source, trial.subject));
        if (!names.emplace(trial.subject, trial.trial).second) {
            return base::fail(fmt::format("{}: trial {} of subject {} is there twice", source,
                                          trial.trial, trial.subject));
        }
    }
    return {};
}

} // namespace

base::Result<Manifest> parse_manifest(std::string_view text, const std::string& source)
{
    const auto json = nlohmann::json::parse(text, nullptr, false);
    const auto kind = json.is_object() ? json.find("kind") : json.end();
    if (!json.is_object() || kind == json.end() || *kind != "hands") {
        return base::fail(source + ": not the manifest of recorded hands, which hapnet-lab import "
                                   "hands writes");
    }
    auto manifest = base::from_json<Manifest>(json, source);
    if (!manifest) return manifest;
    if (const auto good = check(*manifest, source); !good) return tl::unexpected{good.error()};
    return manifest;
}

std::string to_text(const Manifest& manifest) { return base::json_of(manifest).dump(2) + '\n'; }

void put(Manifest& manifest, ImportedTrial trial)
{
    const auto known = std::ranges::find_if(manifest.trials, [&](const ImportedTrial& one) {
        return one.subject == trial.subject && one.trial == trial.trial;
    });
    if (known == manifest.trials.end()) {
        manifest.trials.push_back(std::move(trial));
    } else {
        *known = std::move(trial);
    }
}

bool is_plain_name(std::string_view name)
{
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "0123456789-_";
    constexpr std::size_t longest = 200;
    return !name.empty() && name.size() <= longest &&
           name.find_first_not_of(plain) == std::string_view::npos;
}

} // namespace hapnet::lab::hands
