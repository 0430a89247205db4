#include "coupling/frame/frame_recipe.h"

#include "tests/support/frame_folder.h"
#include "tests/support/test.h"

namespace gestell
{
namespace
{

namespace fs = std::filesystem;

/// A frame whose file names others.
class ContentKeyOfSeveralFiles : public test::FrameFolder
{
protected:
  void write(const std::string &name, const std::string &text)
  {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }

  void read_from(const std::string &name)
  {
    frame.cad = (folder / name).string();
    key       = coupling::content_key(coupling::recipe_of(frame, options));
    EXPECT_FALSE(changes());
  }

  bool changes()
  {
    const std::string before = key;
    key                      = coupling::content_key(coupling::recipe_of(frame, options));
    return key != before;
  }

  fem::FrameSpecification    frame;
  coupling::ReductionOptions options;

private:
  std::string key;
};

TEST_F(ContentKeyOfSeveralFiles, ChangesWithEveryFileThatAScriptNames)
{
  for (const std::string script : {"press.geo", "PRESS.GEO"})
  {
    write(script, "Include \"parts/feet.geo\";\nv() = ShapeFromFile(\"column.step\");\nMerge \"absent.step\";\n");
    write("parts/feet.geo", "Include \"sizes.inc\"; Include \"../press.geo\";\n"); // from its own folder; a circle ends
    write("parts/sizes.inc", "h = 1;\n");
    write("column.step", "one");
    write("sizes.inc", "of another folder");
    fs::remove(folder / "absent.step");
    read_from(script);
    write("parts/sizes.inc", "h = 2;\n");
    EXPECT_TRUE(changes());
    write("column.step", "two");
    EXPECT_TRUE(changes());
    write("absent.step", ""); // now it is there
    EXPECT_TRUE(changes());
    write("sizes.inc", "that no file names");
    EXPECT_FALSE(changes());
  }
}

TEST_F(ContentKeyOfSeveralFiles, ReadsAScriptAsGmshDoes)
{
  write("frame.geo", "Include 'single.geo'; Merge /* the column */ \"column.step\";\n"
                     "// Include \"comment.geo\";\nMergeWithBoundingBox 'boxed.step';\nInclude 'run.msh';\n");
  write("single.geo", "h = 1;\n");
  write("column.step", "one");
  write("boxed.step", "one");
  write("comment.geo", "h = 1;\n");
  write("run.msh", "Include 'by_mesh.geo';\n");
  write("by_mesh.geo", "h = 1;\n");
  read_from("frame.geo");
  for (const std::string file : {"single.geo", "column.step", "boxed.step", "by_mesh.geo"})
  {
    write(file, "h = 2;\n");
    EXPECT_TRUE(changes()) << file;
  }
  write("comment.geo", "h = 2;\n");
  EXPECT_FALSE(changes());
}

TEST_F(ContentKeyOfSeveralFiles, FollowsAScriptOfAnyExtension)
{
  for (const std::string merged : {"parts.geo_unrolled", "parts.opt", "parts.txt", "parts", "parts.Step", "parts.inp"})
  {
    write("frame.geo", "Merge \"" + merged + "\";\n");
    write(merged, "Include \"sizes.inc\";\n");
    write("sizes.inc", "h = 1;\n");
    read_from("frame.geo");
    write("sizes.inc", "h = 2;\n");
    EXPECT_TRUE(changes()) << merged;
    write(merged, "SystemCall \"date\";\n");
    EXPECT_EQ(coupling::beyond_the_files(coupling::recipe_of(frame, options)), merged + ":1: contains SystemCall");
  }
  write("frame.geo", "Merge \"column.step\"; Merge \"mesh.any\";\n");
  write("column.step", "SystemCall \"date\";\n"); // data to gmsh, as is what begins as a mesh
  write("mesh.any", "$MeshFormat\nSystemCall\n");
  EXPECT_EQ(coupling::beyond_the_files(coupling::recipe_of(frame, options)), "");
}

TEST_F(ContentKeyOfSeveralFiles, SaysWhereMoreThanFilesDecides)
{
  for (const std::string line : {"Include StrCat(\"a\", \".geo\");", "name = \"a.geo\"; Include Str(name);",
                                 "h = FileExists(\"a.geo\") ? 1 : 2;", "h = Cpu;", "Printf(GetEnv(\"HOME\"));",
                                 "SystemCall \"date\";", "v() = ShapeFromFile(name);", "t = \"open"})
  {
    write("frame.geo", "// of two lines\n" + line + "\n");
    frame.cad = (folder / "frame.geo").string();
    EXPECT_EQ(coupling::beyond_the_files(coupling::recipe_of(frame, options)).rfind("frame.geo:2: ", 0), 0u) << line;
  }
  write("frame.geo", "Include 'a.geo'; Printf(\"h = %g\", 1); Box(1) = {0, 0, 0, 1, 1, 1};\n");
  EXPECT_EQ(coupling::beyond_the_files(coupling::recipe_of(frame, options)), "");
}

TEST_F(ContentKeyOfSeveralFiles, ChangesWithEveryFileThatAMeshOfAbaqusIncludes)
{
  for (const std::string mesh : {"frame.inp", "FRAME.INP"})
  {
    write(mesh, "** *INCLUDE, INPUT=comment.inc\n*include, input=parts/nodes.inc\n*ELEMENT, TYPE=C3D4,\n"
                "INPUT = \"the cells.inc\"\n*AMPLITUDE, INPUT=force.csv\n");
    write("parts/nodes.inc", "*NODE\n1, 0, 0, 0\n*INCLUDE, INPUT=more.inc\n*INCLUDE, INPUT=nodes.inc\n"); // a circle
    write("parts/more.inc", "2, 1, 0, 0\n");
    write("the cells.inc", "1, 1, 2, 3, 4\n");
    write("force.csv", "0, 1\n");
    write("comment.inc", "");
    read_from(mesh);
    write("parts/nodes.inc", "*NODE\n1, 0, 0, 1\n*INCLUDE, INPUT=more.inc\n");
    EXPECT_TRUE(changes());
    write("parts/more.inc", "2, 2, 0, 0\n");
    EXPECT_TRUE(changes());
    write("the cells.inc", "1, 1, 2, 4, 3\n");
    EXPECT_TRUE(changes());
    write("force.csv", "0, 2\n"); // of no matter for a mesh
    write("comment.inc", "1");
    EXPECT_FALSE(changes());
  }
}

} // namespace
} // namespace gestell
