// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/doctor/findings.hpp"

#include <string>
#include <vector>

namespace hapnet::peer::doctor {

/// The output of `hapnet-peer doctor --json`.
struct Examination {
    bool has_bad = false;
    std::vector<Finding> findings;
};
constexpr auto fields_of(base::Tag<Examination>)
{
    return base::fields(
        "doctor",
        base::member("bad", &Examination::has_bad, "Whether something there cannot be used."),
        base::member("findings", &Examination::findings, "All that was looked at."));
}

[[nodiscard]] Examination examine(const Facts& facts);

/// Returns a line for each finding, followed by what to do about it.
[[nodiscard]] std::string text_of(const Examination& examination);
[[nodiscard]] std::string json_text_of(const Examination& examination);

} // namespace hapnet::peer::doctor
