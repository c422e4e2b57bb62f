// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/time.hpp"

using namespace hapnet::base;
using namespace std::chrono_literals;

#ifdef MUST_COMPILE
constexpr Duration delay = 160ms;
#else
constexpr Duration delay = 160;
#endif
