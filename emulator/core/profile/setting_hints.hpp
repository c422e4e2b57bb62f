// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::emulator {

// Hints for values in the notation of other tools.

// `name` is that of a setting without its direction: "loss".

/// Returns the value with the unit that is commonly left out: "1500" of mtu becomes "1500B".
[[nodiscard]] std::string with_unit(std::string_view name, std::string_view value);

/// Returns the reason `why` a value was refused. Adds the value if `why` does not quote it, and the
/// right notation if the value is close to one.
[[nodiscard]] std::string explained(std::string_view name, const std::string& value,
                                    const std::string& why);

/// Returns where a misplaced key of a profile belongs: "write it below [both], [up] or [down]"; ""
/// for a key that no table of a profile has.
[[nodiscard]] std::string advice_on_key(std::string_view key);

/// Returns an example of a law's notation, by the name of the law or a word that other tools use
/// for it; "" where the setting has no such law.
[[nodiscard]] std::string_view law_example(std::string_view name, std::string_view law);

} // namespace hapnet::emulator
