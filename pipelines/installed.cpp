// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/installed.hpp"

#include <stdexcept>

#include "graph/plugin.hpp"

namespace posevote {

namespace fs = std::filesystem;

fs::path shared_folder() {
  const fs::path library = graph::this_library().parent_path();
  // lib, or lib/x86_64-linux-gnu as Debian has it.
  for (const fs::path& root : {library.parent_path(), library.parent_path().parent_path()})
    if (fs::is_directory(root / "share/posevote/configs")) return root / "share" / "posevote";
  throw std::runtime_error("the configs that come with posevote are not there: expected them in " +
                           (library.parent_path() / "share/posevote").string() + ", beside " +
                           library.string());
}

}  // namespace posevote
