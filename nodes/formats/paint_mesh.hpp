// SPDX-License-Identifier: BSD-3-Clause
// From what a file says of its colours (RawMesh::paint) to the images and each point's place in
// one.
#pragma once

#include <filesystem>

#include "nodes/formats/raw_mesh.hpp"

namespace posevote::formats {

enum class Seams {
  kSplit,  ///< a point whose faces have it in several places of an image becomes several
  kJoin    ///< it stays one, with the first of the places
};

/// Reads the libraries of materials and the images that `mesh.paint` names, in `folder`, and fills
/// `mesh.texture`. Materials without an image have the one colour that they say. Does nothing where
/// there is no paint. Throws std::runtime_error that names the file that is missing or damaged; the
/// mesh then is as it was.
void paint_mesh(RawMesh& mesh, const std::filesystem::path& folder, Seams seams);

}  // namespace posevote::formats
