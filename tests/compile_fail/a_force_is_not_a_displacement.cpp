// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/space.hpp"

using namespace hapnet::base;

const Position here;

#ifdef MUST_COMPILE
const auto there = here + Displacement{};
#else
const auto there = here + Force{};
#endif
