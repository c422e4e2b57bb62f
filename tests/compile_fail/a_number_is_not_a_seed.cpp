// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/random.hpp"

using namespace hapnet::base;

#ifdef MUST_COMPILE
constexpr Seed seed{42};
#else
constexpr Seed seed = 42;
#endif
