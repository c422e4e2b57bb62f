// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/reading.hpp"
#include "scene/description.hpp"

#include <span>
#include <string>
#include <string_view>

namespace hapnet::scene {

// Scenes as people write them, in TOML: docs/formats/scene.md. Every quantity has its unit.

/// Reads a scene. `source` is the name of its file in errors. An error begins with
/// "FILE:LINE:COLUMN: ", states what is wrong and what would be right. The result may be frozen:
/// check() accepts it.
[[nodiscard]] base::Result<Description> parse_scene(std::string_view text,
                                                    const std::string& source);

/// Prints the scene as TOML, each body separately. The text reads back as the same bits if check()
/// accepts the description, also when its fixed bodies are made movable, and if normals and
/// orientations have length 1 within rounding.
[[nodiscard]] std::string to_text(const Description& description);

/// A scene that is built into every program: a file of scripts/scenes.
struct BuiltInScene {
    std::string_view name; // without .toml
    std::string_view text;
};

/// All built-in scenes, by name.
[[nodiscard]] std::span<const BuiltInScene> built_in_scenes();

/// Reads the built-in scene of that name, or else the file whose text `open` returns. A name with a
/// '/', or one that ends in ".toml", is a file. The error names the file and the line, or lists the
/// built-in names.
[[nodiscard]] base::Result<Description> load_scene(const std::string& file_or_name,
                                                   const base::OpenFile& open);

} // namespace hapnet::scene
