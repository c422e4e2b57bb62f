// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/space.hpp"

using namespace hapnet::base;

#ifdef MUST_COMPILE
const auto sum = Force{} + Force{};
#else
const auto sum = Force{} + Velocity{};
#endif
