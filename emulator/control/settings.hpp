// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/request.hpp"
#include "emulator/core/conditions.hpp"
#include "emulator/core/director.hpp"
#include "emulator/core/profile/text.hpp"
#include "proto/base/result.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

// Conversions between the texts of requests and replies and the values that they stand for.

/// Returns the settings of a request. They may be for the paths in `names`.
[[nodiscard]] base::Result<std::vector<Setting>>
settings_of(const SetRequest& request, const OpenFile& open, const PathNames& names);

/// Returns the effect of settings on the path called `name`, whose present state is `path`:
/// burst_loss, for example, changes the present list of losses. Where settings contradict each
/// other, the order of with_settings() decides.
[[nodiscard]] base::Result<Set> set_of(std::span<const Setting> settings,
                                       std::optional<base::Duration> lasting, std::string_view name,
                                       const Path& path);

/// Returns the settings of a patch for one direction as texts: {"up.delay", "80ms"}, ...
/// parse_setting() reads the values.
[[nodiscard]] std::vector<SettingText> texts_of(Direction direction, const Patch& patch,
                                                std::string_view path = {});

/// A setting that differs between two paths. "none": the setting has no effect on that path.
struct Difference {
    std::string key;
    std::string from;
    std::string to;

    friend bool operator==(const Difference&, const Difference&) = default;
};
[[nodiscard]] std::vector<Difference> differences(const Path& from, const Path& to,
                                                  std::string_view path = {});

} // namespace hapnet::emulator
