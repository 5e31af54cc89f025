// SPDX-License-Identifier: BSD-3-Clause
// The formats of files that can be read. A format is one file of this folder, which registers its
// reader with one expression; nothing else names it:
//
//   const auto registered = register_format("OFF", {".off"}, read_off);
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "nodes/formats/depth_image.hpp"
#include "nodes/formats/raw_mesh.hpp"

namespace posevote::formats {

// What a format holds is what its reader makes of the file's bytes. Each throws std::runtime_error
// that says what is wrong and in which line, byte or element.
using ReadMesh = RawMesh (*)(std::string_view bytes);  ///< points, perhaps with normals and faces
using ReadDepth = DepthImage (*)(std::string_view bytes);

/// Of a file that holds many images, whose paths are FILE/NAME: the bytes of one, for the reader. The
/// error does not repeat the path.
using ReadEntry = std::string (*)(const std::filesystem::path& entry);

struct Format {
  std::string name;
  std::vector<std::string> endings;  ///< in lower case, with their dots
  std::variant<ReadMesh, ReadDepth> read;
  ReadEntry entry = nullptr;  ///< null: a file holds one scan

  bool holds_depth() const { return std::holds_alternative<ReadDepth>(read); }
};

/// Throws std::logic_error where another format has one of the endings. The value means nothing: it
/// lets a file register as it is initialised.
bool register_format(const std::string& name, const std::vector<std::string>& endings,
                     std::variant<ReadMesh, ReadDepth> read, ReadEntry entry = nullptr);

/// The format that a file's ending names, in any case, or that of the file in which it lies; null
/// where there is none.
const Format* find_format(const std::filesystem::path& file);

/// The file of many images that a path leads to or into; empty where there is none on it.
std::filesystem::path container_of(const std::filesystem::path& path);
/// What must be there for the path to be read: the file that it leads into, or itself.
std::filesystem::path file_of(const std::filesystem::path& path);

enum class Wanted { kMeshes, kDepthImages, kAny };

/// Whether the file's ending is one of a wanted format.
bool has_ending(const std::filesystem::path& file, Wanted wanted);

/// For messages, sorted: ".obj, .ply or .stl". Files of many images count as any alone.
std::string list_endings(Wanted wanted);

}  // namespace posevote::formats
