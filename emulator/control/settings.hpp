// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/request.hpp"
#include "emulator/core/conditions.hpp"
#include "emulator/core/director.hpp"
#include "emulator/core/profile/text.hpp"
#include "proto/base/result.hpp"

#include <string>
#include <vector>

namespace hapnet::emulator {

// Between the texts of requests and replies and the values that they stand for.

/// What the request means while `path` holds: burst_loss changes the list of losses that holds.
/// "up.…" and "down.…" win over "both.…"; otherwise a later setting wins over an earlier one.
[[nodiscard]] base::Result<Set> set_of(const SetRequest& request, const Path& path,
                                       const OpenFile& open);

/// What a patch sets one way: {"up.delay", "80ms"}, ...; a value is what parse_setting() reads.
[[nodiscard]] std::vector<SettingText> texts_of(Direction direction, const Patch& patch);

/// A setting that differs between two paths. "none": it does nothing there.
struct Difference {
    std::string key;
    std::string from;
    std::string to;

    friend bool operator==(const Difference&, const Difference&) = default;
};
[[nodiscard]] std::vector<Difference> differences(const Path& from, const Path& to);

} // namespace hapnet::emulator
