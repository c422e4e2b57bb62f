// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/reading.hpp"

namespace hapnet::emulator {

// The classes of base for reading texts, on which the language of profiles is built.
using base::DocumentError;
using base::Node;
using base::OpenFile;
using base::parse_document;
using base::Place;
using base::read_value;
using base::Reading;
using base::suggestion;
using base::table_text;
using base::TableReader;
using base::value_text;

} // namespace hapnet::emulator
