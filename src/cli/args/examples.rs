//! The examples at the end of the help.

/// What `-h` shows.
pub(super) const FIRST_EXAMPLES: &str = "\
Examples:
  vcutc init rib --robot kuka/kr210_r3100_ultra   Write a first job
  vcutc check rib.vcut                            Check for errors, write nothing
  vcutc rib.vcut --target krl -o out              Write the KUKA program of a job into the folder out

`vcutc --help` has more examples; `vcutc COMMAND --help` explains a command.";

/// What `--help` shows.
pub(super) const EXAMPLES: &str = "\
Examples:
  vcutc init rib --robot kuka/kr210_r3100_ultra
                                          Write a first job that this robot can cut
  vcutc rib.vcut --target krl -o out      Write the KUKA program of a job into the folder out
  vcutc rib.vcut --target krl -o - | less Read the program without writing a file
  vcutc rib.vcut --target krl --set width=90mm --set depth=40mm
                                          The same job for another stock
  vcutc rib.vcut --target krl -o out --check
                                          Fail with a diff unless out contains the job's program
  vcutc build                             Write all programs that vcut.toml lists
  vcutc check *.vcut                      Check for errors, write nothing
  vcutc report rib.vcut --open            See the cuts, what they leave, and what the machine does
  vcutc explain VC0203                    Read what an error means and how to fix it
  vcutc machines                          List the machines in the catalogue
  vcutc machines kuka/kr210_r3100_ultra   See all numbers of one, and their sources
  vcutc fmt                               Format all job files here
  vcutc fk kuka/kr210_r3100_ultra --joints 0,-90,90,0,45,0
                                          The pose of the flange at these axis values
  vcutc ik kuka/kr210_r3100_ultra --pose 1990,0,1984,0,90,0
                                          All axis values for this pose of the flange
  vcutc plot rib.vcut -o pictures         Draw all pictures in the folder pictures
  vcutc plot rib.vcut --what contour -o rib.svg
                                          Draw what the cuts leave on the part
  vcutc optimize rib.vcut                 See the cost of limits and of a finer surface
  vcutc targets                           List the targets and their options
  vcutc tools rib.vcut --emit apt         Write the tools that stand for the blades in CAM
  vcutc watch rib.vcut --target krl --serve
                                          Compile again after every change, with the report in a browser
  vcutc convert rib_3x.src --rake 60deg --swing 34deg --extension 8mm --stock 85x50x50 --as-job
                                          Convert a three-axis milling program to a job of V-cuts
  vcutc verify rib.vcut out               Check whether a program still matches its job
  vcutc completions bash                  Print a completion script for bash

Streams:
  standard output  results: pages, lists, tables, and programs and pictures with `-o -`
  standard error   errors, warnings, the summary of a job, progress
  `vcutc check rib.vcut 2>&1 | less` shows both, a page at a time.

Exit status:
  0  success
  1  a job has errors, --check found a difference, or there are warnings under --deny-warnings
  2  wrong usage, or a file that cannot be read or written";
