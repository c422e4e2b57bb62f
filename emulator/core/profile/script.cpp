// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/script.hpp"

#include "emulator/core/profile/text.hpp"

#include <functional>
#include <string>
#include <utility>

namespace hapnet::emulator {

namespace {

std::size_t hash_of(Profile profile)
{
    profile.seed.reset();
    return std::hash<std::string>{}(to_text(profile));
}

} // namespace

Script::Script(Profile profile)
    : profile_{std::move(profile)}, timeline_{profile_}, hash_{hash_of(profile_)}
{}

} // namespace hapnet::emulator
