"""The documentation: pages in Markdown, and in generate/ what is made from the code when the site is built."""
