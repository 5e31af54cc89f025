// SPDX-License-Identifier: BSD-3-Clause
#include "tools/experiment/protocol.hpp"

#include <algorithm>
#include <vector>

namespace posevote {

const Protocol& find_protocol(const std::string& name) {
  static const std::vector<Protocol> protocols = {
      {"uwa", "pose", 25,
       "The paper on the real UWA set (recall): pose clustering 1.00 (precision 0.969), RoPS "
       "0.989,\n"
       "EM 0.975, tensor matching 0.966, PPF* 0.936, spin images 0.878.\n"},
      {"queens", "pose", 27,
       "The paper on the real Queen's set (recall): pose clustering 1.00 (precision 1.00), PPF* "
       "0.992,\nRoPS 0.954, VD-LSD 0.838, EM 0.824.\n"},
      {"icbin", "adi15", 60,
       "The paper on the real bin-picking set (recall, top 10; coffee cup / juice): pose "
       "clustering\n"
       "0.638 / 0.449, PPF* 0.474 / 0.279, Doumanoglou 0.335 / 0.251, Tejani 0.314 / 0.248.\n"},
      {"icmi", "adi15", 100,
       "The paper on the real domestic set (best F1; cup, shampoo, joystick, camera, juice, milk;\n"
       "average): pose clustering 0.993 0.709 0.973 0.711 0.975 0.776; 0.856. Doumanoglou 0.932 "
       "0.735\n0.924 0.903 0.819 0.510; 0.803. Tejani 0.633, Drost 0.511, LINEMOD 0.498.\n"},
      {"parts", "add", 20, ""},
      {"household", "adds", 15, ""},
      {"ranges", "add", 9, ""}};
  return *std::find_if(protocols.begin(), protocols.end(),
                       [&](const Protocol& protocol) { return protocol.name == name; });
}

}  // namespace posevote
