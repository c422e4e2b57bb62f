// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace hapnet::emulator {

// Near misses of settings: values that are written as other tools take them.

// `name` is that of a setting without its direction: "loss".

/// The value with the unit that everybody leaves out: "1500" of mtu is "1500B".
[[nodiscard]] std::string with_unit(std::string_view name, std::string_view value);

/// `why` a value was refused, with the value if it is not quoted there, and with what to write
/// where the value is a near miss.
[[nodiscard]] std::string explained(std::string_view name, const std::string& value,
                                    const std::string& why);

/// Says where a misplaced key of a profile belongs: "write it below [both], [up] or
/// [down]"; "" for a key that no table of a profile has.
[[nodiscard]] std::string advice_on_key(std::string_view key);

/// Returns an example of a law's notation, by its name or a word that other tools have for it; ""
/// where the setting has no such law.
[[nodiscard]] std::string_view law_example(std::string_view name, std::string_view law);

} // namespace hapnet::emulator
