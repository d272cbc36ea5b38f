// What the list shows has a label of its own: Neo4j keeps a count for every label, so it need not count a large library.
MATCH (p:Behaviour:Program) WHERE p.name_key IS NOT NULL SET p:Listed;
