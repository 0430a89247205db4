#pragma once

#include "apps/scene/build/build_machine.h"
#include "tests/support/lumped_frame.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace gestell
{

inline const tests::LumpedFrame held = tests::lumped_frame(true), loose = tests::lumped_frame(false);

/// A frame as files and the keys that name them.
struct Import
{
  std::string                                      name;
  std::vector<std::pair<std::string, std::string>> files;
  std::string                                      keys;
  double                                           digits; ///< what the format leaves, as a share
};

inline std::string cards(const tests::LumpedFrame &frame, tests::CardFields fields = tests::CardFields::large)
{
  return tests::grid_text(frame) + tests::dmig_text("KAAX", frame.C, frame.rows, fields) +
         tests::dmig_text("MAAX", frame.M, frame.rows, fields);
}

inline const std::string on_cards = "mass = 'a.pch'\nstiffness = 'a.pch'\n";

inline std::vector<Import> imports(const tests::LumpedFrame &frame)
{
  using tests::CardFields;
  const std::string rows = "rows = 'a.rows'\nnodes = 'a.nodes'\n";
  return {{"DMIG, free", {{"a.pch", cards(frame, CardFields::free_)}}, on_cards, 1e-12},
          {"DMIG, large", {{"a.pch", cards(frame)}}, on_cards, 2e-8},
          {"DMIG, small", {{"a.pch", cards(frame, CardFields::small_)}}, on_cards, 2e-2},
          {"CalculiX",
           {{"a.sti", tests::indexed_text(frame.C)},
            {"a.mas", tests::indexed_text(frame.M)},
            {"a.rows", tests::dof_text(frame.rows)},
            {"a.nodes", tests::inp_text(frame)}},
           "mass = 'a.mas'\nstiffness = 'a.sti'\n" + rows,
           1e-11},
          {"substructure",
           {{"a.mtx", tests::element_matrix_text({{"STIFFNESS", frame.C}, {"MASS", frame.M}}, frame.rows, true)},
            {"a.nodes", tests::inp_text(frame)}},
           "mass = 'a.mtx'\nstiffness = 'a.mtx'\nnodes = 'a.nodes'\n",
           1e-11},
          {"Ansys, Harwell-Boeing",
           {{"K", tests::harwell_boeing_text(frame.C, true)},
            {"M", tests::harwell_boeing_text(frame.M, false)},
            {"a.rows", tests::mapping_text(frame.rows)},
            {"a.nodes", tests::nblock_text(frame)}},
           "mass = 'M'\nstiffness = 'K'\n" + rows,
           1e-12},
          {"Ansys, MatrixMarket",
           {{"K", tests::matrix_market_text(frame.C)},
            {"M", tests::matrix_market_text(frame.M)},
            {"a.rows", tests::mapping_text(frame.rows)},
            {"a.nodes", tests::node_table_text(frame, "m", false)}},
           "mass = 'M'\nstiffness = 'K'\n" + rows,
           1e-12}};
}

struct ImportedFrame : ::testing::Test
{
  test::SceneFolder folder;

  apps::Scene read(const std::string &keys, const std::string &interfaces = node_interface) const
  {
    return apps::read_scene(folder.write("scene.toml", test::quoted("[frame]\n" + keys + interfaces)));
  }
  apps::Scene read(const Import &import, const std::string &more = "", const std::string &after = node_interface) const
  {
    for (const auto &[name, text] : import.files)
      folder.write(name, text);
    return read(import.keys + more, after);
  }
  static void expect(const std::string &text, const std::vector<std::string> &words)
  {
    for (const auto &word : words)
      EXPECT_NE(text.find(word), std::string::npos) << "no '" << word << "' in: " << text;
  }
  /// What is said against keys beside files.
  void refused(const std::string &keys, const std::vector<std::string> &words,
               const std::string &interfaces = node_interface) const
  {
    expect(tests::refusal([&] { read(keys, interfaces); }), words);
  }

  static constexpr const char *node_interface = "[frame.interface.top]\nnode = 12\n";
};

} // namespace gestell
